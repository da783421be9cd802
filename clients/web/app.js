/** The page: its header, the language, the key, and the view the URL names. */

import { onKeyNeeded, waiting } from './api.js';
import { connection } from './connection.js';
import { h, refill } from './dom.js';
import { chooseLanguage, dateTime, has, language, LANGUAGES, loadLanguage, t, textsOf, zoneText } from './i18n.js';
import { keepPage } from './kept_page.js';
import { enterKey } from './key_dialog.js';
import { queue } from './queue.js';
import { currentRoute, lastOf, remember } from './route.js';
import { forget, readStored, store } from './stored.js';
import { pageFile } from './page_files.js';
import { mount as gauge } from './views/gauge.js';

const VIEWS = { gauge };
/** Those that no station begins with come when they are opened, with their texts and style. */
const LATER = {
  fit: () => import('./views/fit.js'), parts: () => import('./views/parts.js'),
  trend: () => import('./views/trend.js'), programs: () => import('./views/programs.js'), overview: () => import('./views/overview.js'),
  tables: () => import('./views/tables.js'), connections: () => import('./views/connections.js'),
  plans: () => import('./views/plans.js'), gauges: () => import('./views/gauges.js'), style: () => import('./views/style.js'),
};
const BAR = ['gauge', 'fit', 'trend', 'overview', 'parts', 'plans', 'programs', 'tables'];
const main = document.getElementById('main');
const printed = document.getElementById('printed');
const viewOf = ({ view }) => (Object.hasOwn(VIEWS, view) || Object.hasOwn(LATER, view) ? view : BAR[0]);
const LOADING_MS = 500;
let loadingSoon = 0;
let leave = () => {};
let shown = '';

async function show() {
  const route = currentRoute();
  const view = viewOf(route);
  remember(view);
  const mount = VIEWS[view] ?? await later(view);
  if (viewOf(currentRoute()) !== view) return;
  const moved = shown && shown !== view;
  shown = view;
  leave();
  document.documentElement.lang = language; // with the view, so that it never names the language of a text that is still to come
  leave = mount(main, route) ?? (() => {});
  document.title = `${t(`view.${view}`)} · fitgauge`;
  drawViews(view);
  if (moved && !main.contains(document.activeElement)) main.querySelector('h1').focus({ preventScroll: true });
}

/**
 * A page that stayed open over an update of the service asks for files that are gone: it loads anew, once. While the service is
 * away it stays at the view it shows: it could not load again.
 */
async function later(view) {
  try {
    const [{ mount }] = await Promise.all([LATER[view](), textsOf(view), styleOfLater()]);
    forget('reloaded', 'session');
    return mount;
  } catch (problem) {
    const isUp = await fetch('/livez', { cache: 'no-store' }).then(({ ok }) => ok, () => false);
    if (!isUp && shown) {
      location.replace(lastOf(shown));
      return new Promise(() => {});
    }
    if (readStored('reloaded', 'session')) throw problem;
    store('reloaded', 'yes', 'session');
    location.reload();
    return new Promise(() => {});
  }
}

let styled = null;
/** The style of all views but the station's, behind it. */
function styleOfLater() {
  styled ??= new Promise((resolve, reject) => {
    const failed = () => { styled = null; link.remove(); reject(new TypeError('no style')); };
    const link = h('link', { rel: 'stylesheet', href: pageFile('style/later.css'), onload: resolve, onerror: failed });
    document.head.append(link);
  });
  return styled;
}

function drawViews(current) {
  refill(document.getElementById('views'), BAR.map((view) =>
    h('a', { href: lastOf(view), 'aria-current': view === current && 'page' }, t(`view.${view}`))));
  // On a narrow screen the views are a row that scrolls.
  const nav = document.getElementById('views');
  const here = nav.querySelector('[aria-current]');
  if (here) nav.scrollLeft = here.offsetLeft - nav.offsetLeft - (nav.clientWidth - here.offsetWidth) / 2;
}

/** What a sheet of paper says of itself: of what it is, where it comes from, when it was printed, with the zone of its times. The place in a list (`at`) is none of it. */
function drawPrinted() {
  const { path, options } = currentRoute();
  const given = [...path, ...Object.entries(options).filter(([name]) => name !== 'at').map(([name, value]) => `${has(`field.${name}`) ? t(`field.${name}`) : name} ${value}`)];
  printed.replaceChildren(h('strong', t(`view.${shown}`)), h('span', given.join(' · ')),
    h('span', `${location.host} · ${dateTime(connection.now())} ${zoneText(connection.now())}`));
}

function drawLink() {
  const link = document.getElementById('link');
  const said = link.firstElementChild;
  const state = !connection.up ? 'away' : queue.isLocked ? 'locked' : queue.size ? 'sending' : 'up';
  const text = t(`link.${state}`, { count: queue.size });
  if (said.textContent !== text) said.textContent = text;
  said.title = t('view.connections');
  link.dataset.state = state;
}

function drawFrame() {
  const select = document.getElementById('language');
  select.replaceChildren(...Object.entries(LANGUAGES).map(([code, name]) =>
    h('option', { value: code, lang: code, selected: code === language }, name)));
  document.getElementById('views').setAttribute('aria-label', t('views'));
  document.getElementById('language-label').textContent = t('language');
  document.getElementById('skip').textContent = t('skip');
  drawLink();
}

/** What waits longer than a blink says so, in every view alike. */
function drawLoading() {
  clearTimeout(loadingSoon);
  const place = document.getElementById('loading');
  if (waiting) loadingSoon = setTimeout(() => { place.textContent = t('loading'); }, LOADING_MS);
  else place.textContent = '';
}

async function changeLanguage(event) {
  await chooseLanguage(event.target.value);
  drawFrame();
  await show();
}

await loadLanguage();
document.documentElement.lang = language; // of the frame, which is there before the first view
onKeyNeeded(enterKey);
document.getElementById('language').addEventListener('change', changeLanguage);
document.getElementById('skip').addEventListener('click', (event) => {
  event.preventDefault();
  main.focus();
});
connection.addEventListener('change', drawLink);
queue.addEventListener('change', drawLink);
addEventListener('keyentered', () => queue.send());
addEventListener('asking', drawLoading);
addEventListener('hashchange', show);
addEventListener('routechange', () => drawViews(viewOf(currentRoute())));
addEventListener('beforeprint', drawPrinted);
drawFrame();
await show();
globalThis.firstKeys = null;
connection.watch();
queue.send();
keepPage();
