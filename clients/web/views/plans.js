/** Plans: what there are, a form for each, and new ones from drawings and tables. */

import { Asked } from '../asked.js';
import { confirm } from '../confirm.js';
import { mayDrop, sayStoredFirst } from '../documents.js';
import { h, refill } from '../dom.js';
import { dateTime, explain, t } from '../i18n.js';
import { inTurn } from '../latest.js';
import { Catalogues } from '../plans/catalogues.js';
import { DropZone } from '../plans/drop_zone.js';
import { csvOf } from '../plans/plan_table.js';
import { PlanForm } from '../plans/plan_form.js';
import { listPlans, readPlan, removePlan, writePlan } from '../plans/plan_store.js';
import { fragment, go } from '../route.js';
import { forget, readJson, store as keep } from '../stored.js';

const draftOf = (part) => `plan-draft/${part}`;
const toStation = (part) => fragment({ view: 'gauge', options: { plan: part } });
const addressOf = (part) => fragment({ view: 'plans', path: part.split('/') });

export function mount(main, route) {
  const leaving = new AbortController();
  const { signal } = leaving;
  let current = null; // {part, tag} of the plan in the form; its part is '' and its tag null while it is new
  let before = '';
  const form = new PlanForm({ onChange: () => showState(), leaving: signal });
  const catalogues = new Catalogues({ onStored: () => form.offer('catalogue'), leaving: signal });
  const note = h('p.note', { role: 'alert' });
  const done = h('p.done', { role: 'status', tabindex: -1 });
  const title = h('span');
  const state = h('span.aside', { role: 'status' });
  const button = (name, onclick, selector = 'button') => h(selector, { type: 'button', onclick }, t(name));
  const storing = h('button.primary', { type: 'submit' }, t('plans.store'));
  const dropping = button('document.drop', () => attempt(drop));
  const ofStored = [button('plans.copy', () => attempt(copyOpen)), button('plans.save_csv', () => saveCsv()), button('plans.delete', () => attempt(() => remove(current.part, current.tag)))];
  const rows = h('tbody');
  const table = h('div.scroll.records.plans-there', { tabindex: 0, role: 'region', 'aria-label': t('view.plans') }, h('table',
    h('thead', h('tr', ['plans.part', 'plans.name', 'plans.count', 'plans.modified'].map((name) => h('th', { scope: 'col' }, t(name))), h('td'))), rows));
  const none = h('p.empty', { hidden: true }, t('plans.none'));
  const list = h('section.plan-list', h('p.actions', button('plans.begin', () => attempt(() => begin()), 'button.primary')), none, table, catalogues.element);
  const editor = h('form.sheet.editor', { novalidate: true, onsubmit: (event) => { event.preventDefault(); attempt(store); } },
    h('div.line', h('h2.title', title, state), h('p.actions', storing, dropping, ofStored, button('plans.all', () => attempt(close)))), note, form.element);
  const drop_zone = new DropZone({
    onDrawing: (draft, tag) => attempt(() => editDraft(draft, tag)), onStored: (part, count) => attempt(() => open(part, t('drawing.stored', { part, count }))),
    onRows: (found) => attempt(() => addRows(found)), onShow: (isOpen) => (isOpen ? hideBoth() : show()),
  });
  const desk = h('div.desk.plans', h('h1.unseen', { tabindex: -1 }, t('view.plans')), drop_zone.element, done, list, editor);
  drop_zone.listen(desk, signal);
  main.replaceChildren(desk);

  const isDirty = () => current !== null && form.text !== before;

  function showState() {
    const dirty = isDirty();
    state.textContent = dirty ? t('plans.not_stored') : '';
    dropping.hidden = !dirty;
    storing.disabled = !dirty && current?.tag !== null;
    for (const each of ofStored) each.hidden = current?.tag === null;
  }

  function say(text) {
    note.textContent = '';
    refill(done, text);
  }

  /** What was stored can be measured by: the next thing somebody wants. @returns the way there */
  function sayStored(text, part) {
    const measure = h('a.button', { href: toStation(part) }, t('plans.measure'));
    note.textContent = '';
    refill(done, text, ' ', measure);
    return measure;
  }

  async function attempt(action) {
    note.textContent = '';
    try {
      await action();
    } catch (problem) {
      (current ? note : done).textContent = explain(problem);
    }
  }

  /** The list, or the form of the plan that is open. */
  function show() {
    list.hidden = current !== null;
    editor.hidden = current === null;
    drop_zone.small = current !== null;
    if (!current) return;
    title.textContent = current.part || t('plans.begin');
    showState();
  }

  function hideBoth() {
    say('');
    list.hidden = true;
    editor.hidden = true;
  }

  const listing = new Asked(async () => {
    const plans = await listPlans(signal);
    none.hidden = plans.length > 0;
    table.hidden = !plans.length;
    refill(rows, plans.map(row));
  }, { say: (text) => { done.textContent = text; }, leaving: signal });
  const refresh = () => listing.run();

  function row({ part, name, characteristics, modified_at: at }) {
    const act = (word, onclick) => h('button.quiet', { type: 'button', 'aria-label': t(`${word}_this`, { part }), onclick: () => attempt(onclick) }, t(word));
    return h('tr', h('td', h('a', { href: addressOf(part), onclick: (event) => { event.preventDefault(); attempt(() => open(part)); } }, part)), h('td', name ?? ''),
      h('td.number', String(characteristics)), h('td', dateTime(new Date(at))),
      h('td', h('a', { href: toStation(part), 'aria-label': t('plans.measure_this', { part }) }, t('plans.measure')),
        act('plans.copy', () => copy(part)), act('plans.delete', () => remove(part))));
  }

  function edit(plan, tag = null, part = '') {
    current = { part, tag };
    form.fill(plan);
    before = form.text;
    go({ view: 'plans', path: part ? part.split('/') : [], options: { new: part ? '' : 'yes' } }, { refine: true });
    show();
    if (tag === null) form.part.focus();
  }

  /** A drawing that goes on in the form: of a plan that is there it is a change of that. */
  async function editDraft(plan, tag) {
    if (!await leaveForm()) return;
    edit(plan, tag, tag === null ? '' : plan.part);
    before = '';
    showState();
    form.firstEmpty()?.focus();
  }

  async function open(part, text = '') {
    if (!await leaveForm()) return;
    const { plan, tag } = await readPlan(part, signal);
    edit(plan, tag, part);
    if (text) sayStored(text, part).focus();
    else say('');
  }

  async function begin() {
    if (await leaveForm()) edit();
    say('');
  }

  async function copy(part) {
    if (!await leaveForm()) return;
    const { plan } = await readPlan(part, signal);
    edit({ ...plan, part: '' });
    say(t('plans.copy_of', { part }));
  }
  const copyOpen = () => copy(current.part);

  async function close() {
    if (!await leaveForm()) return;
    current = null;
    go({ view: 'plans' }, { refine: true });
    say('');
    show();
    await refresh();
  }

  const leaveForm = async () => !isDirty() || mayDrop();

  async function drop() {
    const { part, tag } = current;
    if (!await leaveForm()) return;
    current = null;
    if (tag !== null) await open(part).catch(async (problem) => { await close(); throw problem; });
    else await close();
  }

  /** @param replacing whether what stands there now is replaced, whoever has written it */
  const store = inTurn(async ({ replacing = false } = {}) => {
    if (!current || (!replacing && storing.disabled)) return;
    const part = form.part.value.trim();
    if (!part) {
      form.notes.part.textContent = t('plans.part_missing');
      form.part.focus();
      return;
    }
    // Under another number it is another plan.
    const edited = current;
    const isOther = edited.tag !== null && part !== edited.part;
    const [plan, text] = [form.value, form.text];
    try {
      const stored = await writePlan(part, plan, replacing ? undefined : isOther ? null : edited.tag);
      if (current !== edited) {
        await refresh(); // another is open, or the list
        return;
      }
      current = { part, tag: stored };
      form.clear();
      before = text;
      go({ view: 'plans', path: part.split('/') }, { refine: true });
      show();
      sayStored(t('plans.stored', { part, count: plan.characteristics.length }), part);
      // Enter that is pressed again goes nowhere; what is typed meanwhile goes on in its field.
      if (!isDirty()) done.focus();
    } catch (problem) {
      if (problem.status === 412) {
        sayStoredFirst(note, part, isOther || edited.tag === null, { open: () => attempt(() => open(part)), replace: () => attempt(() => store({ replacing: true })) });
      } else if (problem.errors?.length) note.textContent = form.mark(problem).join(' ') || t('plans.wrong');
      else throw problem;
    }
  }, () => form.text);

  async function remove(part, tag) {
    if (!await confirm(t('plans.delete_sure', { part }), t('plans.delete'))) return;
    await removePlan(part, tag);
    current = null;
    await close();
    say(t('plans.deleted', { part }));
  }

  function addRows({ file, part, characteristics, unused }) {
    if (!current) edit({ part, characteristics: [] });
    const first = form.addAll(characteristics);
    if (part && !form.part.value) form.part.value = part;
    showState();
    say([t('file.added', { count: characteristics.length, name: file }), unused.length && t('file.unused', { names: unused.join(', ') })].filter(Boolean).join(' '));
    (form.part.value ? first : form.part).focus();
  }

  function saveCsv() {
    const bytes = URL.createObjectURL(new Blob([csvOf(form.value)], { type: 'text/csv' }));
    h('a', { href: bytes, download: `${current.part.replace(/[\\/:*?"<>|]/g, '_')}.csv` }).click();
    setTimeout(() => URL.revokeObjectURL(bytes), 60_000);
  }

  /** What was changed and not stored is kept while the window lives. */
  function keepDraft() {
    if (!current) return;
    if (isDirty()) keep(draftOf(current.part), JSON.stringify({ ...current, text: form.text }), 'session');
    else forget(draftOf(current.part), 'session');
  }

  function restore() {
    const part = route.path.join('/');
    const draft = readJson(draftOf(part), null, 'session');
    if (!draft || (!part && !route.options.new)) return false;
    forget(draftOf(part), 'session');
    edit(JSON.parse(draft.text), draft.tag, draft.part);
    before = '';
    showState();
    say(t('plans.restored'));
    return true;
  }

  addEventListener('pagehide', keepDraft, { signal });
  /** What the address names, unless somebody has opened another meanwhile. */
  const beginning = new Asked(async () => {
    const part = route.path.join('/');
    if (current) return;
    if (part) await open(part);
    else if (route.options.new) edit();
    else await refresh();
  }, { say: (text) => { done.textContent = text; }, leaving: signal });

  show();
  if (!restore()) beginning.run();
  catalogues.begin(route.options.catalogue);
  return () => {
    keepDraft();
    catalogues.keepDraft();
    leaving.abort();
  };
}
