/** The gauging station: what is measured, the value, the verdict, and the values before it. */

import { url } from '../api.js';
import { connection } from '../connection.js';
import { h } from '../dom.js';
import { Decimal, judge, nmFromMm, toJson } from '../exact.js';
import { Arrivals } from '../gauge/arrivals.js';
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
    onChange: (another) => jobChanged(another), onDone: () => entry.focus(),
  });
  const entry = new Entry({
    job: () => job.current(),
    prefixes: () => job.prefixes,
    onValue: (value) => post(value),
    onJob: (designation) => job.adopt(designation),
    onField: (name, text, correcting) => (correcting ? correct(correcting, String(correcting.measured_mm), { [name]: text }) : job.set(name, text)),
    onOpen: (typed) => panel.open(typed),
    onDropped: (text) => recent.set({
      key: `dropped-${performance.now()}`, state: 'dropped', shown: shownOf(text), reason: t('recent.dropped_why'),
    }),
  });
  const recent = new Recent({ onCorrect: (record, what) => entry.correct(record, what) });
  const arrivals = new Arrivals();

  const next = () => panel.next({ limits: job.limits, part: job.part });

  /** A verdict stands for one part and one size: another one begins without. */
  function jobChanged(another) {
    const path = job.designation ? [job.designation] : [];
    go({ view: 'gauge', path, options: job.options }, { refine: true });
    if (another || panel.state === undefined || panel.state === 'idle') next();
  }

  function shownOf(measured) {
    const { part_id, characteristic } = job.options;
    const { limits } = job;
    return {
      measured, part_id, characteristic, designation: limits?.designation ?? job.designation, at: connection.now(), limits,
      verdict: limits && judge(nmFromMm(measured), limits, job.guard),
    };
  }

  function bodyOf(text) {
    const { text: designation, uncertainty } = job.current();
    const given = FIELDS.map((name) => [name, job.inputs[name].value.trim()]).filter(([, value]) => value);
    const rule = uncertainty ? { rule: 'guard_band', uncertainty_um: new Decimal(uncertainty) } : {};
    return { designation, measured_mm: new Decimal(text), ...Object.fromEntries(given), ...rule };
  }

  function post({ text, correcting }) {
    if (correcting) return correct(correcting, text);
    job.renew();
    return send(url(['measurements']), bodyOf(text), shownOf(text), true);
  }

  function correct(record, measured, fields = {}) {
    const { part_id, characteristic, designation } = { ...record, ...fields };
    const shown = { measured, part_id, characteristic, designation, at: connection.now() };
    const body = { measured_mm: new Decimal(measured), ...fields, reason: t('correction.reason') };
    send(url(['measurements', record.id, 'corrections']), body, shown, false);
  }

  function send(path, body, shown, timed) {
    const { key } = queue.add(path, toJson(body), { ...shown, late: !connection.up }, timed);
    recent.set({ key, state: 'waiting', shown });
    setTimeout(() => {
      if (queue.entries.some((waiting) => waiting.key === key)) panel.waiting(shown, !connection.up);
    }, GAP_MS);
  }

  const { signal } = leaving;
  entry.input.addEventListener('focus', () => job.fold());
  entry.takeKeys(signal);
  addEventListener('strayline', ({ detail }) => entry.take(detail), { signal });
  queue.addEventListener('stored', ({ detail: { entry: { key, shown }, record } }) => {
    recent.set({ key, state: 'stored', shown, record });
    if (shown.late) arrivals.stored(record);
    // A verdict that comes late is no verdict of the part that lies there now.
    if (!shown.late) panel.judged(record);
    else if (!queue.size) next();
  }, { signal });
  queue.addEventListener('refused', ({ detail: { entry: { key, shown }, problem } }) => {
    recent.set({ key, state: 'refused', shown, reason: explain(problem) });
    if (shown.late) arrivals.refused(shown, explain(problem));
    else panel.refused(shown, explain(problem));
  }, { signal });
  connection.addEventListener('change', () => {
    if (connection.up || !queue.size) return;
    for (const waiting of queue.entries) queue.mark(waiting, { late: true });
    panel.waiting(queue.entries.at(-1).shown, true);
  }, { signal });

  document.addEventListener('keydown', (event) => {
    const typing = event.target.closest?.('input, select, textarea, dialog');
    const undo = (event.ctrlKey || event.metaKey) && event.key === 'z';
    if (undo && recent.last && (!typing || (typing === entry.input && !entry.input.value))) {
      event.preventDefault();
      entry.correct(recent.last);
    }
  }, { signal });
  addEventListener('focus', () => document.activeElement === document.body && entry.focus(), { signal });

  main.replaceChildren(h('div.gauge', h('h1.unseen', { tabindex: -1 }, t('view.gauge')),
    h('div.station', job.element, entry.element, arrivals.element, panel.element), recent.element));
  remember('gauge');
  job.start();
  if (job.designation) entry.focus();
  else job.input.focus();
  return () => leaving.abort();
}
