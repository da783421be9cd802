/** A run of an NC program among the records it has left. */

import { getJson, url } from '../api.js';
import { h, refill } from '../dom.js';
import { dateTime, t } from '../i18n.js';
import { fileName } from '../programs/disk.js';
import { fragment } from '../route.js';
import { verdictMark } from '../verdict.js';

/** As many as a row of records has. */
const COLUMNS = 9;

/** @param leaving ends the question how the run went */
export function runRow(id, leaving) {
  const link = h('a', { href: fragment({ view: 'programs', options: { run: id } }) }, t('parts.run', { id: id.split('-')[0] }));
  const cell = h('td', { colspan: COLUMNS }, link);
  getJson(url(['runs', id]), { signal: leaving }).then(({ program, status, verdict, finished_at: at }) => refill(cell, link,
    h('span.aside', [fileName(program), t(`run.${status}`), at && dateTime(new Date(at))].filter(Boolean).join(' · ')), verdict && verdictMark(verdict)),
  // A run goes before its records do.
  ({ status }) => status === 404 && link.replaceWith(link.textContent));
  return h('tr.run', cell);
}
