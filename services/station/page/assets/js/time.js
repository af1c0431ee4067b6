// Moments by this person's clock, in the page's language, always from 0 to 24 hours.

const FROM_0_TO_24 = { hourCycle: "h23" };

export function timeOfDay(iso) {
  return shown(iso, (moment, language) => moment.toLocaleTimeString(language, FROM_0_TO_24));
}

// With the day, where it is not today.
export function timeOf(iso) {
  return shown(iso, (moment, language) =>
    moment.toDateString() === new Date().toDateString()
      ? moment.toLocaleTimeString(language, FROM_0_TO_24)
      : moment.toLocaleString(language, FROM_0_TO_24),
  );
}

function shown(iso, as) {
  const moment = new Date(iso);
  return !iso || Number.isNaN(moment.getTime()) ? "" : as(moment, document.documentElement.lang);
}
