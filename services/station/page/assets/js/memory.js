// What a browser remembers for whoever sits at it. In a frame it is theirs whom the address names, and nobody else's.
// A browser may forbid it: then everything is said anew next time.

export function remembered(name, otherwise = null) {
  try {
    return localStorage.getItem(place(name));
  } catch {
    return otherwise;
  }
}

export function remember(name, value) {
  try {
    localStorage.setItem(place(name), value);
  } catch {
    // Nothing can be kept.
  }
}

// What whoever shows this page in a frame says of it; null where nobody does.
export function addressed(what) {
  return document.body.dataset.framed === "yes" ? new URLSearchParams(location.hash.slice(1)).get(what) : null;
}

function place(name) {
  const person = addressed("person");
  return person ? `${name}-${person}` : name;
}
