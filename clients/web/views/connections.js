/** The connections to the world outside: how each is, a form for a new one, and whether the other side can be reached. */

import { getJson, request, url } from '../api.js';
import { confirm } from '../confirm.js';
import { field, h, refill } from '../dom.js';
import { dateTime, explain, number, t } from '../i18n.js';
import { untilLifted } from '../press.js';
import { go } from '../route.js';
import { resolved, SchemaForm, schemas } from '../schema_form.js';

const EVERY_MS = 3000;
const NAME = '[A-Za-z0-9_\\-]{1,63}';
/** What a connection says of itself beside its settings. */
const kindOf = (schema) => schema.properties.kind.enum[0];

export function mount(main, route) {
  const leaving = new AbortController();
  const { signal } = leaving;
  const note = h('p.note', { role: 'status' });
  const rows = h('tbody');
  const table = h('div.scroll.records', { tabindex: 0, role: 'region', 'aria-label': t('view.connections'), hidden: true },
    h('table', h('thead', h('tr', ['connection.name', 'connection.state', 'connection.lag', 'connection.last', 'connection.did']
      .map((name) => h('th', { scope: 'col' }, t(name))), h('td'))), rows));
  const name = h('input', { type: 'text', name: 'name', pattern: NAME, required: true, autocomplete: 'off', spellcheck: 'false', maxlength: 63 });
  const kind = h('select', { name: 'kind', onchange: () => draw() });
  const fields = h('div');
  const wrong = h('p.note', { role: 'alert' });
  const tried = h('p.tried', { role: 'status' });
  const storing = h('button.primary', { type: 'submit' }, t('connection.store'));
  const testing = h('button', { type: 'button', onclick: () => test() }, t('connection.test'));
  const form = h('form.sheet', { novalidate: true, onsubmit: (event) => { event.preventDefault(); attempt(store); } },
    h('h2', t('connection.one')), h('div.pair', field(t('connection.name'), name, t('connection.name_hint')), field(t('connection.kind'), kind)),
    fields, wrong, tried, h('p.actions', storing, testing, h('button', { type: 'button', onclick: () => begin() }, t('connection.new'))));
  let kinds = new Map();
  let all = {};
  let shown = null;
  let known = [];
  let timer = 0;
  let isAsked = false;
  let toOpen = route.path[0];

  main.replaceChildren(h('div.desk.connections', h('h1.unseen', { tabindex: -1 }, t('view.connections')), note, table, form));

  /** @param settings of a connection that is there */
  function draw(settings) {
    shown = new SchemaForm(kinds.get(kind.value), all).fill(settings && Object.fromEntries(Object.entries(settings)
      .filter(([member]) => member in kinds.get(kind.value).properties)));
    fields.replaceChildren(shown.element);
    wrong.textContent = '';
    tried.textContent = '';
  }

  function begin() {
    name.value = '';
    remember();
    draw();
    lock();
    name.focus();
  }

  const remember = () => go({ view: 'connections', path: name.value ? [name.value] : [] }, { refine: true });

  function open(connection) {
    name.value = connection.name;
    kind.value = connection.kind;
    remember();
    draw(connection);
    lock(connection.read_only);
  }

  /** Those of the configuration file are changed there. */
  function lock(readOnly = false) {
    for (const control of form.querySelectorAll('input, select, textarea')) control.disabled = readOnly;
    storing.disabled = readOnly;
    if (readOnly) wrong.textContent = t('connection.read_only');
  }

  async function attempt(action) {
    wrong.textContent = '';
    tried.textContent = '';
    try {
      await action();
    } catch (problem) {
      say(problem);
    }
  }

  /** What is wrong stands at its field; what has none below them. */
  function say(problem) {
    const errors = (problem.errors ?? []).map((error) => ({ pointer: error.pointer ?? '', text: explain({ status: problem.status, code: problem.code, errors: [error], reason: error.detail }), detail: error.detail }));
    const left = shown?.mark(errors.map(({ pointer, text, detail }) => ({ pointer, text: detail && detail !== text ? `${text} (${detail})` : text }))) ?? errors;
    wrong.textContent = errors.length && !left.length ? t('connection.wrong') : left.map(({ text }) => text).join(' ') || explain(problem);
  }

  async function store() {
    if (!name.checkValidity()) {
      wrong.textContent = t('connection.name_hint');
      name.focus();
      return;
    }
    shown.mark([]);
    const response = await request('PUT', url(['connections', name.value]), { body: shown.value });
    const connection = await response.json();
    tried.textContent = t('connection.stored', { name: connection.name });
    remember();
    await list();
  }

  /** The service tries what is stored. */
  const test = () => attempt(async () => {
    if (!known.some((one) => one.name === name.value)) await store();
    if (wrong.textContent) return;
    tried.textContent = t('connection.testing');
    const { ok, detail } = await (await request('POST', url(['connections', name.value, 'test']))).json();
    refill(tried, h('strong', { class: ok ? 'good' : 'reject' }, t(ok ? 'connection.reached' : 'connection.failed')), ' ', h('span', { lang: 'en' }, detail));
  });

  const remove = (connection) => attempt(async () => {
    if (!await confirm(t('connection.remove_sure', { name: connection.name }), t('connection.remove'))) return;
    await request('DELETE', url(['connections', connection.name]));
    if (name.value === connection.name) begin();
    await list();
  });

  /** Asked again and again, so after an outage too; for a key only once. */
  async function list() {
    clearTimeout(timer);
    try {
      if (!kinds.size) await offerKinds();
      const asks = !isAsked;
      isAsked = true;
      const found = await getJson(url(['connections']), { signal, asks });
      await untilLifted();
      known = found.connections;
      note.textContent = known.length ? '' : t('connection.none');
      table.hidden = !known.length;
      refill(rows, known.map((one) => row(one, { onOpen: () => open(one), onRemove: () => remove(one) })));
      openNamed();
    } catch (problem) {
      if (!signal.aborted) note.textContent = explain(problem);
    }
    if (!signal.aborted) timer = setTimeout(list, EVERY_MS);
  }

  async function offerKinds() {
    all = await schemas();
    kinds = new Map(all.ConnectionOrder.oneOf.map((one) => resolved(one, all)).map((schema) => [kindOf(schema), schema]));
    kind.append(...[...kinds.keys()].map((each) => h('option', { value: each }, t(`connection.kind.${each}`))));
    draw();
  }

  /** The one that the address names, unless somebody has begun another meanwhile. */
  function openNamed() {
    const named = !name.value && known.find((one) => one.name === toOpen);
    toOpen = undefined;
    if (named) open(named);
  }

  list();
  return () => {
    leaving.abort();
    clearTimeout(timer);
  };
}

/** What it has done since the service was started, as far as it has done any of it. */
const DONE = ['measurements', 'files', 'refused', 'unreadable', 'failures'];

function row(one, { onOpen, onRemove }) {
  const did = DONE.filter((member) => one[member] > 0);
  return h('tr', { 'data-state': one.state },
    h('td', h('button.quiet', { type: 'button', onclick: onOpen }, one.name), h('span.aside', t(`connection.kind.${one.kind}`))),
    h('td', h('strong', { class: one.state === 'ok' ? 'good' : one.state === 'failing' || one.state === 'stopped' ? 'reject' : '' }, t(`connection.state.${one.state}`)),
      one.last_error && h('span.aside', { lang: 'en' }, one.last_error)),
    h('td', one.lag_s === null ? '–' : `${number(one.lag_s.toFixed(1))} s`, one.behind > 0 && h('span.aside', t('connection.behind', { count: one.behind }))),
    h('td', one.last_success_at ? dateTime(new Date(one.last_success_at)) : '–'),
    h('td', did.map((member) => h('span.aside', t(`connection.count.${member}`, { count: one[member] })))),
    h('td', !one.read_only && h('button.quiet', { type: 'button', onclick: onRemove, 'aria-label': t('connection.remove_this', { name: one.name }) }, t('connection.remove'))));
}
