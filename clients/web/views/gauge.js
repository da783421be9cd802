/** The gauging station: what is measured, the value, the verdict, and the values before it. */

import { url } from '../api.js';
import { connection } from '../connection.js';
import { parseDesignation } from '../designation.js';
import { h } from '../dom.js';
import { Decimal, judge, leastOf, nmFromMm, toJson } from '../exact.js';
import { Arrivals } from '../gauge/arrivals.js';
import { Badge } from '../gauge/badge.js';
import { follow } from '../events.js';
import { Entry } from '../gauge/entry.js';
import { FIELDS } from '../gauge/fields.js';
import { forgetAtHand, limitsOf } from '../gauge/held.js';
import { Job } from '../gauge/job.js';
import { ledger } from '../gauge/ledger.js';
import { NumberPad } from '../gauge/number_pad.js';
import { Panel } from '../gauge/panel.js';
import { askOfValues } from '../gauge/part_record.js';
import { pictureOf } from '../gauge/picture.js';
import { ownLimits, Plan } from '../gauge/plan.js';
import { Reactions } from '../gauge/reaction.js';
import { Recent } from '../gauge/recent.js';
import { SerialGauge } from '../gauge/serial.js';
import { soundChoice } from '../gauge/sound.js';
import { explain, t } from '../i18n.js';
import { isKept } from '../kept_page.js';
import { queue, randomText } from '../queue.js';
import { go, remember } from '../route.js';

/** Most answers come sooner: then what the page cannot judge itself replaces the last verdict without a gap. */
const GAP_MS = 120;

export function mount(main, route) {
  const leaving = new AbortController();
  let partBefore = route.options.part_id ?? '';
  const panel = new Panel((record) => recent.like(record));
  /** Why no value is taken now; '' where one is. */
  const reason = () => reactions.reason || (plan.loading ? t('entry.busy') : '') || plan.reason;
  // The badge that has logged in is the operator: the record names the badge, and no name of the one before.
  const badge = new Badge({ onIn: () => {
    job.set('operator', '');
    next();
  } });
  const reactions = new Reactions({ ledger, operator: () => job.options.operator, named: (text) => entry.named(text, true, true), onDone: () => entry.focus() });
  const entry = new Entry({
    job: () => (reason() ? { reason: reason() } : job.current()),
    subject: () => `${plan.chosen}\n${job.subject}`,
    gauged: () => job.current(),
    isSize: (field) => field === job.input,
    prefixes: () => job.prefixes.texts, pattern: () => plan.plan?.part_pattern ?? '',
    onValue: (value) => post(value),
    onJob: (designation, scanned) => adopt(designation, scanned),
    onField: (name, text, correcting) => (correcting ? correct(correcting, String(correcting.measured_mm), { [name]: text, ...(correcting.confirmed && { confirmed: true }) }) : setField(name, text)),
    onBadge: (key) => badge.take(key),
    isKnown: (text) => plan.knows(text),
    isName: (name) => FIELDS.includes(name),
    onTyped: () => { if (stepped) next(); },
    onOpen: (typed, why) => {
      panel.open(typed, why);
      show();
    },
    onAsk: (question) => {
      if (question) {
        panel.ask(question);
        show();
      } else if (!panel.answered()) next();
    },
    recordOf: (id) => recent.inForce(id),
    onCorrecting: (record, what) => {
      pad.signed(leastOf(record ?? job.limits) < 0);
      return record ? panel.correcting(record, what) : panel.answered();
    },
    onTest: (result) => panel.scanner(result, job.prefixes.fieldOf(result.before)),
    onDropped: (text) => {
      const key = `dropped-${randomText()}`;
      ledger.dropped(key, shownOf(text), t('recent.dropped_why'));
      recent.add(key);
    },
  });
  const pad = new NumberPad(entry.input);
  const serial = new SerialGauge({ onValue: (text) => entry.take(text), onUnread: unread, leaving: leaving.signal });
  const job = new Job({
    designation: route.path[0] ?? '', options: route.options, choices: [soundChoice(), pad.choice, serial.element],
    onChange: (another) => jobChanged(another), onDone: () => entry.focus(),
    named: (text, ended) => entry.named(text, ended),
  });
  const recent = new Recent({ ledger, onCorrect: (record, what) => entry.correct(record, what), onProblem: (why) => entry.unread(why), leaving: leaving.signal });
  const arrivals = new Arrivals(leaving.signal);
  const unkept = h('p.unkept', { role: 'status' });

  const plan = new Plan({
    ledger,
    onStep: (one) => job.follow(one, ownLimits(one)), onAgain: () => entry.focus(), onChoose: (part) => choosePlan(part), onRecord: () => sayPartAnew(),
    machine: () => job.options.machine, subject: () => job.part, leaving: leaving.signal,
  });
  let stepped = false;

  /** A gauge sent what is no value: no verdict may stand for it. */
  function unread(why, line) {
    panel.open(line, why);
    show();
    entry.unread(why);
  }

  /** The last value of a part is judged: its verdict gives way to that of the part. */
  function sayPart() {
    const result = plan.result;
    if (result) panel.part(result);
  }

  function sayPartAnew() {
    if (!panel.isOfPart) return;
    if (plan.result) sayPart();
    else next();
  }

  /** A value was corrected elsewhere. @param shown the record that stands in the panel, unless that shows a part */
  function corrected(record, shown) {
    recent.add(record.id);
    if (shown?.id !== record.correction_of) return;
    if (record.part_id !== shown.part_id) return next();
    panel.begin(record.id);
    panel.judged(record);
    sayPart();
  }

  const askOfOpen = () => askOfValues(ledger, ledger.open);

  /** The part was measured elsewhere, or may have been. */
  function partIsOld() {
    plan.record.forget();
    sayPartAnew();
  }

  /** A value without an answer. While the service is away it may be the last of a part. */
  function showWaiting(shown, how) {
    panel.waiting(shown, !connection.up, how);
    if (!connection.up) sayPart();
  }

  /** The value that stands in the panel has no answer yet, and somebody wonders why. */
  function sayWaiting() {
    const waiting = queue.entries.find(({ key }) => key === panel.of);
    if (waiting) showWaiting(waiting.shown, t(queue.held.includes(waiting) ? 'panel.held_how' : queue.isLocked ? 'panel.locked_how' : 'panel.waiting_how'));
  }

  /** What became of a line is seen, also above a number pad on a phone. */
  const show = () => panel.element.scrollIntoView({ block: 'nearest' });

  const next = () => {
    stepped = false;
    if (plan.result && job.part) return sayPart();
    return panel.next({ limits: job.limits, part: job.part, step: plan.what, finished: plan.finished, picture: plan.finished ? null : pictureOf(plan.current) });
  };

  /** A scan that changes the size says so: the number of a part may look like one. */
  async function adopt(designation, scanned) {
    const before = job.limits?.designation;
    const known = await job.adopt(designation);
    if (known && scanned && job.limits?.designation && job.limits.designation !== before) panel.size(job.limits);
    return known;
  }

  async function choosePlan(part, again) {
    if (!await plan.load(part, again)) return;
    if (!plan.part) job.leavePlan();
    prepare();
    stepped = false;
    jobChanged(true);
    entry.focus();
  }

  /** Fetches what the steps of the plan will need, so that none waits for it. */
  function prepare() {
    reactions.prepare(plan.catalogues);
    for (const text of plan.designations) limitsOf(parseDesignation(text)?.text ?? text).catch(() => {});
  }

  /** The next part: the plan may have been changed since the last. */
  async function begin() {
    if (plan.loading) return undefined; // what is being asked for begins with this part
    if (!plan.part || !connection.up) return plan.begin();
    if (await plan.load(plan.part)) {
      prepare();
      jobChanged(true);
    }
    return undefined;
  }

  /** A part number that has a plan is no part: it says what is measured from now on. */
  function setField(name, text) {
    if (name === 'part_id' && plan.knows(text)) choosePlan(text);
    else job.set(name, text);
  }

  /** A verdict stands for one part and one size: another one begins without. */
  function jobChanged(another) {
    const path = job.designation ? [job.designation] : [];
    go({ view: 'gauge', path, options: { ...job.options, plan: plan.chosen, ...(plan.part && { gauge: job.ownGauge }) } }, { refine: true });
    entry.jobChanged();
    if (!entry.correcting) pad.signed(leastOf(job.limits) < 0);
    if (plan.samples.ofAnother) plan.samples.renew();
    if (job.part !== partBefore) {
      partBefore = job.part;
      begin();
      stepped = false;
    }
    if (stepped) return;
    if (another || panel.state === undefined || panel.state === 'idle') next();
  }

  function shownOf(measured) {
    const { part_id, characteristic, machine } = job.options;
    const { limits } = job;
    return {
      measured, part_id, characteristic, machine, designation: limits?.designation ?? job.designation, at: connection.now(), limits, go_gauge: job.envelope.said,
      verdict: limits && job.envelope.said !== 'fails' && !job.isInsideCorner ? judge(nmFromMm(measured), limits, job.rule.guard) : null,
    };
  }

  function bodyOf(measured, subgroup, confirmed) {
    const { text, own, feature, envelope } = job.current();
    const designation = envelope ? `${text}(E)` : text;
    const given = FIELDS.map((name) => [name, job.fields.of(name)]).filter(([, value]) => value);
    const exact = (value) => (value === undefined ? undefined : new Decimal(String(value)));
    const limits = own ? {
      nominal_mm: exact(own.nominal_mm), feature: own.feature, ...(own.quantity && { quantity: own.quantity }), upper_um: exact(own.upper_deviation_um), lower_um: exact(own.lower_deviation_um),
    } : { designation, feature };
    return { ...limits, measured_mm: new Decimal(measured), ...Object.fromEntries(given), ...(subgroup && { subgroup }), ...(confirmed && { confirmed }), ...(job.isInsideCorner && { inside_corner: true }), ...job.rule.body, ...job.envelope.take(!envelope) };
  }

  function post({ text, correcting, confirmed }) {
    if (correcting) return correct(correcting, text, confirmed && { confirmed });
    const subgroup = plan.sample;
    stepped = Boolean(plan.current);
    const shown = shownOf(text);
    const body = bodyOf(text, subgroup, confirmed);
    plan.step(send(url(['measurements']), body, { ...shown, subgroup, confirmed, ...plan.begun() }));
    if (!connection.up) sayPart();
    return undefined;
  }

  /** @param fields what else it corrects; the page judges a correction by the limits of its record, if they alone decide */
  function correct(record, measured, fields = {}) {
    const { part_id, characteristic, designation, rule = 'simple' } = { ...record, ...fields };
    const isBySize = rule === 'simple' && record.go_gauge !== 'fails' && !record.inside_corner;
    const verdict = isBySize ? judge(nmFromMm(measured), record) : null;
    const shown = { measured, part_id, characteristic, designation, confirmed: fields.confirmed, at: connection.now(), limits: record, verdict };
    const body = { measured_mm: new Decimal(measured), ...fields, reason: t('correction.reason') };
    send(url(['measurements', record.id, 'corrections']), body, shown, record);
  }

  /** @param of the record that it corrects, which has its time already @returns its key */
  function send(path, body, shown, of) {
    const { key } = queue.add(path, toJson(body), { ...shown, late: !connection.up }, !of);
    panel.begin(key);
    if (shown.verdict) showWaiting(shown);
    ledger.taken(key, shown, of);
    recent.add(key);
    show();
    setTimeout(() => { if (panel.of === key) sayWaiting(); }, GAP_MS);
    return key;
  }

  const { signal } = leaving;
  entry.input.addEventListener('focus', () => job.fold());
  entry.takeKeys(signal);
  addEventListener('strayline', ({ detail: { text, burst } }) => entry.take(text, burst), { signal });
  queue.addEventListener('stored', ({ detail: { entry: { key, shown }, record } }) => {
    recent.add(key);
    // It may have been told of before its own answer came.
    if (ledger.stateOf(ledger.get(key)) === 'open') askOfOpen();
    plan.samples.take(record);
    badge.named(record.caller);
    if (shown.late) arrivals.stored(record);
    // A verdict that comes late is no verdict of what is gauged now. What was not seen and is not good is shown all the same.
    const isSeen = record.verdict === 'good' || record.verdict === shown.verdict;
    if (!shown.late) {
      const isOvertaken = panel.of !== key && isSeen;
      panel.judged(record, isOvertaken);
      if (!isOvertaken) {
        sayPart();
        show();
      }
    } else if (!queue.values.length) next();
  }, { signal });
  queue.addEventListener('refused', ({ detail: { entry: { key, of, shown }, problem } }) => {
    const reason = explain(problem);
    // The note of a value that was refused goes to the one in its place.
    if (of) return ledger.get(of)?.state === 'refused' ? undefined : entry.unread(t('note.refused', { reason }));
    recent.add(key);
    if (shown.late) arrivals.refused(key, shown, reason);
    if (!shown.late || panel.of === key) panel.refused(shown, reason);
  }, { signal });
  ledger.addEventListener('change', ({ detail: { value, elsewhere } }) => {
    recent.draw(value);
    reactions.draw();
    plan.changed(value, elsewhere);
    sayPartAnew();
  }, { signal });
  function sayUnkept() {
    unkept.textContent = connection.up || (isKept() && queue.isKept) ? '' : t(isKept() ? 'gauge.unstored' : 'gauge.unkept');
  }
  queue.addEventListener('change', () => {
    sayUnkept();
    if (queue.isLocked) sayWaiting();
    badge.renew();
  }, { signal });
  connection.addEventListener('change', () => {
    sayUnkept();
    if (connection.up) partIsOld();
    if (connection.up || !queue.values.length) return;
    for (const waiting of queue.entries) queue.mark(waiting, { late: true });
    sayWaiting();
  }, { signal });

  document.addEventListener('keydown', (event) => {
    const typing = event.target.closest?.('input, select, textarea, dialog');
    const undo = (event.ctrlKey || event.metaKey) && event.key === 'z';
    const { last } = recent;
    if (undo && last !== undefined && (!typing || (typing === entry.input && !entry.input.value))) {
      event.preventDefault();
      if (last) entry.correct(last);
      else entry.unread(t('recent.not_yet'));
    }
  }, { signal });
  addEventListener('focus', () => document.activeElement === document.body && entry.focus(), { signal });

  main.replaceChildren(h('div.gauge', h('h1.unseen', { tabindex: -1 }, t('view.gauge')),
    h('div.station', plan.element, job.element, pad.element, entry.element, badge.element, unkept, reactions.element, arrivals.element, panel.element), recent.element));
  remember('gauge');
  entry.resume();
  job.start(leaving.signal);
  follow(leaving.signal, ({ type, data }) => {
    if (type === 'measurement.recorded') {
      const record = JSON.parse(data);
      const shown = ledger.get(panel.of)?.record;
      const wasPart = panel.isOfPart;
      ledger.told(record);
      plan.samples.told(record);
      if (ledger.get(record.id)) corrected(record, !wasPart && shown);
      const isOwn = ledger.of(plan.part, job.part).some((value) => value.record?.id === record.id);
      if (!isOwn && (record.part_id === job.part || record.correction_of)) partIsOld();
    }
    if (type === 'note.added') ledger.noted(JSON.parse(data));
    if (type === 'resync') {
      plan.samples.renew();
      askOfOpen();
      plan.askElsewhere();
      partIsOld();
    }
    if (type !== 'table.changed' && type !== 'resync') return;
    forgetAtHand();
    prepare();
    job.renew();
  });
  addEventListener('keyforgotten', () => badge.draw(), { signal });
  addEventListener('keyentered', () => {
    badge.draw();
    plan.list();
    job.keyed();
  }, { signal });
  if (route.options.plan) choosePlan(route.options.plan, true);
  plan.list().then(() => {
    // It was scanned before it was known which plans there are.
    if (!plan.chosen && plan.knows(job.part)) {
      const { part } = job;
      job.set('part_id', '');
      setField('part_id', part);
    }
    // Where there are plans, a station begins with the scan of one.
    if (plan.known.length && document.activeElement === job.input && !job.designation) entry.focus();
  });
  if (job.designation || entry.correcting) entry.focus();
  else job.input.focus();
  entry.takeFirst();
  askOfOpen();
  return () => leaving.abort();
}
