/** The page's words in the reader's language. */

import en from './lang/en.js';
import { readStored, store } from './stored.js';

export const LANGUAGES = { en: 'English', de: 'Deutsch', nl: 'Nederlands', it: 'Italiano' };
/** What the service says is English already. */
const TEXTS = {
  en: () => [],
  de: () => [import('./lang/de_codes.js'), import('./lang/de.js')],
  nl: () => [import('./lang/nl_codes.js'), import('./lang/nl.js')],
  it: () => [import('./lang/it_codes.js'), import('./lang/it.js')],
};

/** Texts that come with the views that are opened later. */
const LATER = {
  plans: { en: () => import('./lang/plans_en.js'), de: () => import('./lang/plans_de.js'), nl: () => import('./lang/plans_nl.js'), it: () => import('./lang/plans_it.js') },
  desk: { en: () => import('./lang/desk_en.js'), de: () => import('./lang/desk_de.js'), nl: () => import('./lang/desk_nl.js'), it: () => import('./lang/desk_it.js') },
  figures: { en: () => import('./lang/figures_en.js'), de: () => import('./lang/figures_de.js'), nl: () => import('./lang/figures_nl.js'), it: () => import('./lang/figures_it.js') },
};
const TEXTS_OF = { plans: ['desk', 'plans'], trend: ['desk', 'figures'], gauges: ['desk', 'figures'] };
const opened = new Set();

let words = en;
export let language = 'en';

/** The language chosen, else the first of the browser's (its Accept-Language) that the page has. */
function preferred() {
  const chosen = readStored('language');
  if (chosen in LANGUAGES) return chosen;
  return navigator.languages.map((tag) => tag.slice(0, 2)).find((tag) => tag in LANGUAGES) ?? 'en';
}

/** For dates: English is British, which writes the day first. */
const locale = () => (language === 'en' ? 'en-GB' : language);

export async function loadLanguage(wanted = preferred()) {
  const texts = await Promise.all([...TEXTS[wanted](), ...[...opened].map((group) => LATER[group][wanted]())]);
  words = Object.assign({}, en, ...texts.map((text) => text.default));
  language = wanted;
}

/** The texts of a view that is opened later. */
export async function textsOf(view) {
  const groups = (TEXTS_OF[view] ?? ['desk']).filter((group) => !opened.has(group));
  if (!groups.length) return;
  for (const group of groups) opened.add(group);
  await loadLanguage(language);
}

export async function chooseLanguage(wanted) {
  store('language', wanted);
  await loadLanguage(wanted);
}

/** The text of a name, its {places} filled in. */
export function t(name, values = {}) {
  return words[name].replace(/\{(\w+)\}/g, (_, place) => values[place] ?? '');
}

/** Whether there is a text of that name. */
export const has = (name) => name in words;

/** A decimal as it is written here: comma but in English, and a true minus. */
export function number(text) {
  const local = language === 'en' ? String(text) : String(text).replace('.', ',');
  return local.replace('-', '\u2212');
}

/** With its sign, zero without. */
export const signed = (text) => (/^[-0]*$|^-/.test(String(text)) ? number(text) : `+${number(text)}`);

const formats = {};
/** A format of dates, made once for a language: to make one takes longer than to write a hundred dates. */
const dateFormat = (name, options) => (formats[`${name} ${language}`] ??= new Intl.DateTimeFormat(locale(), options));

export const time = (date) => dateFormat('time', { hour: '2-digit', minute: '2-digit', second: '2-digit', hourCycle: 'h23' }).format(date);
export const timeOfDay = (date) => dateFormat('timeOfDay', { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' }).format(date);
export const date = (day) => dateFormat('date', { day: 'numeric', month: 'short', year: 'numeric' }).format(day);
export const dayAndMonth = (day) => dateFormat('dayAndMonth', { day: '2-digit', month: '2-digit' }).format(day);
/** The day here, as a field for a date has it: "2026-11-27". */
export const dayText = (moment) => [moment.getFullYear(), moment.getMonth() + 1, moment.getDate()].map((part) => String(part).padStart(2, '0')).join('-');
export const dateTime = (moment) => `${date(moment)}, ${time(moment)}`;
/** The zone of all times that are shown, at a moment: "CET". */
export const zoneText = (moment) => dateFormat('zone', { timeZoneName: 'short' }).formatToParts(moment).find(({ type }) => type === 'timeZoneName').value;

/** Why a call failed, in the reader's language, with the field it is about. */
export function explain(problem) {
  if (problem instanceof TypeError || problem instanceof DOMException) return t('error.away');
  if (!problem.status) return problem.message;
  const [first] = problem.errors;
  const known = [first?.code, problem.code].find((code) => has(`error.${code}`));
  if (!known) return problem.reason;
  return [t(`error.${known}`), language !== 'en' && known === first?.code && first.pointer].filter(Boolean).join(' ');
}

/** What a check found, in the reader's language; without a text of its own the service's. */
export const findingText = ({ code, message }) => (has(`finding.${code}`) ? t(`finding.${code}`) : message);
