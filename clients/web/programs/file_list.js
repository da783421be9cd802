/** The files of the control's disk by folder, and the way new ones get there. */

import { field, h, refill } from '../dom.js';
import { t } from '../i18n.js';

export class FileList {
  /** @param onPick takes a path; @param onUpload takes a folder and the files chosen; @param onBegin the path of a new program */
  constructor({ onPick, onUpload, onBegin }) {
    this.onPick = onPick;
    this.folder = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false' });
    this.folder.value = 'nc_prog';
    this.chooser = h('input.unseen', {
      type: 'file', multiple: true, 'aria-label': t('programs.upload'),
      onchange: () => this.#chosen(onUpload),
    });
    this.name = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', pattern: '[\\w\\-]+(\\.[hHiI])?', required: true });
    this.list = h('div.files');
    this.element = h('aside.disk',
      h('form.upload', { onsubmit: (event) => event.preventDefault() },
        field(t('programs.folder'), this.folder),
        h('label.field.chooser', h('span.label', t('programs.upload')), this.chooser, h('span.choose', { 'aria-hidden': 'true' }, t('programs.choose')))),
      h('form.line.begin', { onsubmit: (event) => { event.preventDefault(); this.#begun(onBegin); } },
        field(t('programs.begin'), this.name), h('button', { type: 'submit' }, t('programs.write'))),
      h('nav', { 'aria-label': t('programs.files') }, this.list));
  }

  async #chosen(onUpload) {
    await onUpload(this.#folder, [...this.chooser.files]);
    this.chooser.value = '';
  }

  get #folder() {
    return this.folder.value.trim().replace(/^\/+|\/+$/g, '');
  }

  #begun(onBegin) {
    const name = this.name.value.replace(/(\.[hi])?$/i, (ending) => ending || '.h');
    this.name.value = '';
    onBegin([this.#folder, name].filter(Boolean).join('/'));
  }

  show(files, current) {
    const folders = new Map();
    for (const { path } of files) {
      const at = path.lastIndexOf('/');
      const folder = at < 0 ? '' : path.slice(0, at);
      folders.set(folder, [...(folders.get(folder) ?? []), path]);
    }
    refill(this.list, [...folders].map(([folder, paths]) => h('section', h('h2.aside', `TNC:\\${folder.replaceAll('/', '\\')}`),
      h('ul', paths.map((path) => h('li', h('button', {
        type: 'button', 'aria-current': path === current && 'true', onclick: () => this.onPick(path),
      }, path.slice(path.lastIndexOf('/') + 1))))))));
    if (!files.length) this.list.replaceChildren(h('p.aside', t('programs.no_files')));
  }
}
