// Moments by this person's clock, in the page's language, always from 0 to 24 hours; with the day, where it is not today.

const FROM_0_TO_24 = { hourCycle: "h23" };

export function timeOf(iso) {
  const moment = new Date(iso);
  if (!iso || Number.isNaN(moment.getTime())) return "";
  const { lang } = document.documentElement;
  return moment.toDateString() === new Date().toDateString()
    ? moment.toLocaleTimeString(lang, FROM_0_TO_24)
    : moment.toLocaleString(lang, FROM_0_TO_24);
}
