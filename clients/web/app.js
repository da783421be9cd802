/** The page: its header, the language, the key, and the view the URL names. */

import { onKeyNeeded } from './api.js';
import { connection } from './connection.js';
import { h } from './dom.js';
import { chooseLanguage, language, LANGUAGES, loadLanguage, t } from './i18n.js';
import { enterKey } from './key_dialog.js';
import { queue } from './queue.js';
import { currentRoute, lastOf, remember } from './route.js';

const VIEWS = ['gauge', 'fit', 'trend', 'programs', 'tables'];
const main = document.getElementById('main');
let leave = () => {};

async function show() {
  const route = currentRoute();
  const view = VIEWS.includes(route.view) ? route.view : VIEWS[0];
  remember(view);
  const { mount } = await import(`./views/${view}.js`);
  leave();
  leave = mount(main, route) ?? (() => {});
  document.title = `${t(`view.${view}`)} · fitgauge`;
  drawViews(view);
}

function drawViews(current) {
  document.getElementById('views').replaceChildren(...VIEWS.map((view) =>
    h('a', { href: lastOf(view), 'aria-current': view === current && 'page' }, t(`view.${view}`))));
}

function drawLink() {
  const link = document.getElementById('link');
  const state = connection.up ? (queue.size ? 'sending' : 'up') : 'away';
  const text = t(`link.${state}`, { count: queue.size });
  if (link.textContent !== text) link.textContent = text;
  link.dataset.state = queue.size || !connection.up ? state : 'up';
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

async function changeLanguage(event) {
  await chooseLanguage(event.target.value);
  drawFrame();
  await show();
}

await loadLanguage();
onKeyNeeded(enterKey);
document.getElementById('language').addEventListener('change', changeLanguage);
document.getElementById('skip').addEventListener('click', (event) => {
  event.preventDefault();
  main.focus();
});
connection.addEventListener('change', drawLink);
queue.addEventListener('change', drawLink);
addEventListener('hashchange', show);
addEventListener('routechange', () => drawViews(currentRoute().view));
drawFrame();
await show();
connection.watch();
queue.send();
