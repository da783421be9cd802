/** The gauges: which are in use and until when, their calibrations, and the study of one. */

import { h } from '../dom.js';
import { Calibrations } from '../gauges/calibrations.js';
import { StudyForm } from '../gauges/study_form.js';
import { t } from '../i18n.js';
import { go } from '../route.js';

export function mount(main, route) {
  const leaving = new AbortController();
  const calibrations = new Calibrations({
    gauge: route.path[0] ?? '', onGauge: (name) => go({ view: 'gauges', path: [name] }, { refine: true }), leaving: leaving.signal,
  });
  const study = new StudyForm(leaving.signal);
  main.replaceChildren(h('div.desk.gauges', h('h1', { tabindex: -1 }, t('view.gauges')), calibrations.element, study.element));
  return () => leaving.abort();
}
