/** The parts: what was measured at which, found by part, order or whatever else a record says; the newest first. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { designationText } from '../designation.js';
import { field, h } from '../dom.js';
import { downloadLink } from '../download.js';
import { follow } from '../events.js';
import { FilterBar, searched } from '../filter_bar.js';
import { date, dateTime, signed, t, time } from '../i18n.js';
import { Latest } from '../latest.js';
import { untilLifted } from '../press.js';
import { fragment, go } from '../route.js';
import { CertificateForm } from '../parts/certificate.js';
import { correct } from '../parts/correction.js';
import { LongList } from '../parts/long_list.js';
import { note } from '../parts/note.js';
import { partSheet, PartVerdicts } from '../parts/part_verdict.js';
import { runRow } from '../parts/run_row.js';
import { limitsText, measuredText, noteText, operatorOf, placesOf, recordMark, VERDICTS } from '../verdict.js';

const FIELDS = ['part_id', 'characteristic', 'cause'];
/** What the service writes a list as, by its `format`. */
const FORMS = { csv: 'CSV', xlsx: 'Excel', dfq: 'Q-DAS', qif: 'QIF' };
/** Many events make one reading. */
const GATHER_MS = 500;
/** Of the times in a workbook. */
const ZONE = Intl.DateTimeFormat().resolvedOptions().timeZone ?? '';

export function mount(main, route) {
  const leaving = new AbortController();
  const inputs = Object.fromEntries(FIELDS.map((name) => [name,
    h('input', { type: 'text', name, autocomplete: 'off', spellcheck: 'false', onchange: ({ target }) => { searched(target); search(); } })]));
  const bar = new FilterBar(route.options, () => search());
  for (const name of FIELDS) inputs[name].value = route.options[name] ?? '';
  const verdict = h('select', { name: 'verdict', onchange: () => search() }, ['', ...VERDICTS, 'unjudged'].map((word) =>
    h('option', { value: word, selected: word === (route.options.verdict ?? '') }, word ? t(`verdict.${word}`) : t('parts.any'))));
  const corrected = h('input', { type: 'checkbox', checked: route.options.history === 'all', onchange: () => search() });
  const said = h('p.note', { role: 'status' });
  /** Why a file or certificate is not there: it stays, whatever happens to the list meanwhile. */
  const refused = h('p.note', { role: 'alert' });
  const refuse = (reason = '') => { refused.textContent = reason; };
  const table = h('table', h('thead', h('tr', { 'aria-rowindex': 1 }, ['field.part_id', 'field.characteristic', 'trend.verdict', 'trend.value', 'parts.deviation', 'parts.limits', 'parts.by', 'trend.time']
    .map((name) => h('th', { scope: 'col' }, t(name))), h('td'))), h('tbody'));
  const list = new LongList(table, t('view.parts'), {
    read, rowOf, count, headOf: (run) => runRow(run, leaving.signal), leaving: leaving.signal,
    onPlace: (rank) => { if (location.hash === address) toAddress(rank, true); },
    onProblem: (problem) => asked.fail(problem),
  });
  const verdicts = new PartVerdicts(list.scroller, leaving.signal);
  const ofPart = h('div.of-one-part', { role: 'status' });
  const sheet = new Latest(leaving.signal);
  const exported = Object.fromEntries(Object.entries(FORMS).map(([format, form]) => [format,
    downloadLink({ download: `measurements.${format}` }, t('parts.save', { form }), refuse, { bounded: format !== 'csv' })]));
  const certificate = new CertificateForm(refuse);
  for (const link of [...Object.values(exported), certificate.link]) link.addEventListener('click', () => refuse());
  /** How many rows are older than the first in sight. */
  let at = /^\d+$/.test(route.options.at ?? '') ? Number(route.options.at) : undefined;
  /** Of this list: where another is chosen, the place does not count. */
  let address;
  /** The decimals of its values, by the first rows that were read. */
  let places;

  main.replaceChildren(h('div.desk.parts', h('h1.unseen', { tabindex: -1 }, t('view.parts')),
    h('form.line', { onsubmit: (event) => { event.preventDefault(); search(); } },
      FIELDS.map((name) => field(t(`field.${name}`), inputs[name])), field(t('trend.verdict'), verdict), bar.element,
      h('button.unseen', { type: 'submit', tabindex: -1 }, t('parts.search'))),
    h('p.actions', Object.values(exported), h('label.choice', corrected, h('span', t('parts.history'))), list.place), certificate.element, ofPart, said, refused, list.scroller));

  /** As the address has it. */
  const options = () => ({ ...filter(), source: '', from: '', to: '', ...bar.options, at });
  /** As the service takes it. What runs have measured belongs to the history of a part. */
  const filter = () => ({
    source: inputs.part_id.value.trim() ? 'all' : '',
    ...bar.query, ...Object.fromEntries(FIELDS.map((name) => [name, inputs[name].value.trim()])), verdict: verdict.value, history: corrected.checked ? 'all' : '',
  });

  function toAddress(rank, quiet) {
    at = rank;
    go({ view: 'parts', options: options() }, { refine: true, quiet });
    address = location.hash;
  }

  const say = (text = '') => { said.textContent = text || (list.length === 0 ? t('parts.none') : ''); };
  const asked = new Asked(async (rank, isAgain) => {
    toAddress(rank);
    for (const [format, link] of Object.entries(exported)) link.href = url(['measurements'], { ...filter(), format, time_zone: format === 'xlsx' ? ZONE : '' });
    const { part_id, order } = filter();
    certificate.show({ part_id, order });
    said.textContent = '';
    if (!isAgain) refuse();
    places = undefined;
    verdicts.forget();
    showPart(part_id);
    await list.open(rank, isAgain);
    if (list.length === 0) say();
  }, { again: () => search(at, true), say, leaving: leaving.signal });
  const search = (rank, isAgain) => asked.run(rank, isAgain);

  /** Of one part the sheet of its verdict. */
  function showPart(part) {
    if (part !== ofPart.dataset.part) ofPart.replaceChildren();
    ofPart.dataset.part = part;
    sheet.run(async (signal) => (part ? partSheet(part, signal) : null)).then((found) => found !== undefined && ofPart.replaceChildren(...[found].filter(Boolean)), (problem) => asked.fail(problem));
  }

  const listed = async (asked, signal) => (await getJson(url(['measurements'], { ...filter(), ...asked }), { signal })).measurements;

  /** A record does not say that it was corrected: it is missing among those that count. */
  async function read(asked, signal) {
    const [records, current] = await Promise.all([listed({ ...asked, notes: 'shown' }, signal), corrected.checked && listed({ ...asked, history: '' }, signal)]);
    places ??= placesOf(records);
    const counting = current && new Set(current.map(({ id }) => id));
    return records.map((record) => ({ record, isReplaced: counting && !counting.has(record.id) }));
  }

  async function count(before, signal) {
    const { groups } = await getJson(url(['measurements', 'summary'], { ...filter(), group_by: 'machine', received_to: before }), { signal });
    return groups.reduce((sum, group) => sum + group.count, 0);
  }

  function rowOf({ record, isReplaced }) {
    return row(record, isReplaced, { places, verdicts, onCorrect: () => change(record), onNote: () => addNote(record) });
  }

  async function change(record) {
    if (await correct(record)) search(undefined, true);
  }

  async function addNote(record) {
    if (await note(record)) search(at, true);
  }

  /** What happens elsewhere: rows come at the top; what a held row says anew takes the whole list anew. */
  let timer = 0;
  let isAnew = false;
  let isFollowed = false;
  let isInDoubt = false;
  function arrived({ type, data }) {
    const told = JSON.parse(data);
    if (type === 'note.added') {
      const row = list.rowOfRecord(told.measurement_id);
      if (!row || row.record.notes?.some(({ id }) => id === told.id)) return;
      isAnew = true;
    } else if (type === 'measurement.recorded') {
      const isCorrected = list.rowOfRecord(told.correction_of) !== undefined;
      if (!isCorrected && !isListed(told)) return;
      isAnew ||= isCorrected;
      verdicts.renew(told.part_id);
    } else if (type === 'resync') {
      // The first comes when the stream begins: what the list has not read by then, no event tells.
      isAnew ||= isFollowed;
      isInDoubt = isFollowed = true;
    } else return;
    timer ||= setTimeout(renew, GATHER_MS);
  }

  function isListed(record) {
    return bar.has(record) && ['part_id', 'characteristic'].every((name) => ['', record[name]].includes(filter()[name]));
  }

  async function renew() {
    if (isInDoubt && !isAnew && !list.isBusy) {
      const isOld = await list.isOld(leaving.signal).catch(() => null);
      isInDoubt = isOld === null;
      isAnew ||= isOld;
    }
    await untilLifted();
    // Somebody may have gone elsewhere meanwhile: that comes first.
    if (leaving.signal.aborted) return;
    timer = list.isBusy ? setTimeout(renew, GATHER_MS) : 0;
    if (timer || location.hash !== address) return;
    if (isAnew) {
      isAnew = false;
      search(at, true);
    } else {
      showPart(filter().part_id);
      await list.renew();
      if (!asked.failed) say();
    }
  }

  bar.offer(leaving.signal);
  search(at).then(() => follow(leaving.signal, arrived));
  return () => {
    leaving.abort();
    clearTimeout(timer);
  };
}

function row(record, isReplaced, { places, verdicts, onCorrect, onNote }) {
  const { part_id: part } = record;
  const act = (name, onclick) => h('button.quiet', {
    type: 'button', onclick, 'aria-label': t(`${name}_this`, { mm: measuredText(record), part: part ?? t('part.none') }),
  }, t(name));
  return h('tr', { class: isReplaced && 'corrected' },
    h('td', part ? h('a', { href: fragment({ view: 'parts', options: { part_id: part, history: 'all' } }) }, part) : '–', part && verdicts.placeOf(part)),
    h('td', record.characteristic ?? '', h('span.aside', record.designation ? designationText(record.designation) : '')),
    h('td', recordMark(record), (isReplaced || record.correction_of)
      && h('span.aside', [t(isReplaced ? 'recent.corrected' : 'parts.correction'), record.conflict && t('parts.conflict'), record.reason].filter(Boolean).join(' · ')),
    record.confirmed && h('span.aside', t('confirmed.mark')),
    (record.notes ?? []).map((one) => h('span.aside.noted', [noteText(one), operatorOf(one), dateTime(new Date(one.received_at))].filter(Boolean).join(' · ')))),
    h('td.number', measuredText(record, places)), h('td.number', record.deviation_um === undefined ? '–' : `${signed(record.deviation_um)} µm`), h('td', limitsText(record)),
    h('td', [record.source === 'simulation' && t('parts.simulated'), operatorOf(record), record.machine, record.tool, record.gauge].filter(Boolean).join(' · ')),
    h('td', date(new Date(record.measured_at)), h('span.aside', time(new Date(record.measured_at)))),
    h('td', !isReplaced && act('parts.correct', onCorrect), act('note.add', onNote)));
}
