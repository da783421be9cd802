/** The gauging station: what is measured, the value, the verdict, and the values before it. */

import { url } from '../api.js';
import { connection } from '../connection.js';
import { h } from '../dom.js';
import { Decimal, toJson } from '../exact.js';
import { Entry } from '../gauge/entry.js';
import { FIELDS, Job } from '../gauge/job.js';
import { Panel } from '../gauge/panel.js';
import { Recent } from '../gauge/recent.js';
import { explain, t } from '../i18n.js';
import { queue } from '../queue.js';
import { go, remember } from '../route.js';

/** An answer that takes no longer replaces the last verdict without a gap. */
const GAP_MS = 120;

export function mount(main, route) {
  const leaving = new AbortController();
  const panel = new Panel();
  const job = new Job({
    designation: route.path[0] ?? '', options: route.options,
    onChange: () => jobChanged(), onDone: () => entry.focus(),
  });
  const entry = new Entry({
    job: () => job.current(),
    onValue: (value) => post(value),
    onOpen: (typed) => panel.open(typed),
    onDropped: (text) => recent.set({
      key: `dropped-${performance.now()}`, state: 'dropped', shown: shownOf(text), reason: t('recent.dropped_why'),
    }),
  });
  const recent = new Recent({ onCorrect: (record) => entry.correct(record) });

  function jobChanged() {
    const path = job.designation ? [job.designation] : [];
    go({ view: 'gauge', path, options: job.options }, { refine: true });
    panel.idle(job.limits);
  }

  const shownOf = (measured) => ({ measured, designation: job.limits?.designation ?? job.designation, at: connection.now() });

  function bodyOf(text) {
    const { text: designation, uncertainty } = job.current();
    const given = FIELDS.map((name) => [name, job.inputs[name].value.trim()]).filter(([, value]) => value);
    const rule = uncertainty ? { rule: 'guard_band', uncertainty_um: new Decimal(uncertainty) } : {};
    return {
      designation, measured_mm: new Decimal(text), measured_at: connection.now().toISOString(),
      ...Object.fromEntries(given), ...rule,
    };
  }

  function post({ text, correcting }) {
    const path = correcting ? url(['measurements', correcting.id, 'corrections']) : url(['measurements']);
    const body = correcting ? { measured_mm: new Decimal(text), reason: t('correction.reason') } : bodyOf(text);
    const shown = shownOf(text);
    const { key } = queue.add(path, toJson(body), shown);
    recent.set({ key, state: 'waiting', shown });
    setTimeout(() => {
      if (queue.entries.some((waiting) => waiting.key === key)) panel.waiting(shown, !connection.up);
    }, GAP_MS);
  }

  const { signal } = leaving;
  entry.input.addEventListener('focus', () => job.fold());
  queue.addEventListener('stored', ({ detail: { entry: { key, shown }, record } }) => {
    panel.judged(record);
    recent.set({ key, state: 'stored', shown, record });
  }, { signal });
  queue.addEventListener('refused', ({ detail: { entry: { key, shown }, problem } }) => {
    panel.refused(shown, explain(problem));
    recent.set({ key, state: 'refused', shown, reason: explain(problem) });
  }, { signal });
  connection.addEventListener('change', () => {
    if (!connection.up && queue.size) panel.waiting(queue.entries.at(-1).shown, true);
  }, { signal });

  // Figures typed anywhere but in a field belong to the value; Ctrl+Z in an empty one undoes.
  document.addEventListener('keydown', (event) => {
    const typing = event.target.closest?.('input, select, textarea, dialog');
    if (!typing && /^[\d.,]$/.test(event.key) && !event.ctrlKey && !event.altKey && !event.metaKey) entry.focus();
    const undo = (event.ctrlKey || event.metaKey) && event.key === 'z';
    if (undo && recent.last && (!typing || (typing === entry.input && !entry.input.value))) {
      event.preventDefault();
      entry.correct(recent.last);
    }
  }, { signal });
  addEventListener('focus', () => document.activeElement === document.body && entry.focus(), { signal });

  main.replaceChildren(h('div.gauge', h('h1.unseen', t('view.gauge')),
    h('div.station', job.element, entry.element, panel.element), recent.element));
  remember('gauge');
  job.start();
  if (job.designation) entry.focus();
  else job.input.focus();
  return () => leaving.abort();
}
