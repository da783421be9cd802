/** The inspection certificate of a part or an order: the sheet is the service's own PDF. */

import { url } from '../api.js';
import { field, h } from '../dom.js';
import { downloadLink } from '../download.js';
import { t } from '../i18n.js';
import { readStored, store } from '../stored.js';

const KEPT_COMPANY = 'company';
const KEPT_PAPER = 'paper';
const PAPERS = { a4: 'A4', letter: 'Letter' };

/** Where the sheet is: with the company and the paper that were given last. @param of {part_id, order}: one of them or both */
const sheetOf = (of, customer) => url(['certificates'], {
  ...of, title: t('certificate.title'), company: readStored(KEPT_COMPANY), customer, paper: readStored(KEPT_PAPER) ?? 'a4',
});

/** Opens the sheet of a part beside the station. It leaves the focus, so that no scan opens it again. */
export function certificateLink(part, onProblem) {
  const link = downloadLink({ target: '_blank', href: sheetOf({ part_id: part }), 'aria-label': t('certificate.of', { part }) }, t('parts.certificate'), onProblem);
  link.addEventListener('click', () => link.blur());
  return link;
}

export class CertificateForm {
  /** @param onProblem takes why the sheet could not be had */
  constructor(onProblem) {
    const text = () => h('input', { type: 'text', autocomplete: 'organization', maxlength: 200, oninput: () => this.#changed() });
    this.company = text();
    this.company.value = readStored(KEPT_COMPANY) ?? '';
    this.customer = text();
    this.paper = h('select', { onchange: () => this.#changed() }, Object.entries(PAPERS).map(([value, name]) =>
      h('option', { value, selected: value === readStored(KEPT_PAPER) }, name)));
    this.link = downloadLink({ target: '_blank' }, t('certificate.open'), onProblem);
    this.element = h('details.certificate', h('summary', t('parts.certificate')),
      h('div.line', field(t('certificate.company'), this.company), field(t('certificate.customer'), this.customer),
        field(t('certificate.paper'), this.paper), this.link));
  }

  /** @param of {part_id, order}: one of them or both; without either there is no certificate */
  show(of) {
    this.of = of;
    this.element.hidden = !of.part_id && !of.order;
    this.#changed();
  }

  #changed() {
    store(KEPT_COMPANY, this.company.value.trim());
    store(KEPT_PAPER, this.paper.value);
    this.link.href = sheetOf(this.of, this.customer.value.trim());
  }
}
