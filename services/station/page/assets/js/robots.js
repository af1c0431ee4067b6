// The ways to the other robots' pages. Who is here, and as what, goes along; the robot that is left behind holds.

const LOOPBACK = new Set(["localhost", "127.0.0.1", "[::1]"]);

export function showRobots({ name, role }) {
  for (const way of document.querySelectorAll(".robot-way")) {
    const address = addressHere(way.dataset.address ?? "");
    if (address === null) {
      way.removeAttribute("href");
      continue;
    }
    address.searchParams.set("name", name);
    address.searchParams.set("role", role);
    way.href = address.href;
  }
}

// Null where there is none, or where it is seen on another computer only.
function addressHere(text) {
  if (!/^https?:\/\/[^/]/.test(text)) return null;
  const url = new URL(text);
  if (!LOOPBACK.has(url.hostname)) return url;
  if (!LOOPBACK.has(location.hostname)) return null;
  url.hostname = location.hostname;
  return url;
}
