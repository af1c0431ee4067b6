// What the scripts say, out of the station's one table of words; what stands in braces is filled in here.

const table = JSON.parse(document.getElementById("words").textContent);

export function say(key, facts = {}) {
  return table[key].replace(/\{(\w+)\}/g, (_, name) => facts[name]);
}
