/** The gauges: which are in use and until when, their calibrations, the study of one, and uncertainty budgets. */

import { h } from '../dom.js';
import { Budgets } from '../gauges/budgets.js';
import { Calibrations } from '../gauges/calibrations.js';
import { StudyForm } from '../gauges/study_form.js';
import { t } from '../i18n.js';
import { go } from '../route.js';

export function mount(main, route) {
  const leaving = new AbortController();
  const at = { gauge: route.path[0] ?? '', budget: route.options.budget ?? '' };
  const remember = (changed) => go({ view: 'gauges', path: Object.assign(at, changed).gauge ? [at.gauge] : [], options: { budget: at.budget } }, { refine: true });
  const calibrations = new Calibrations({ gauge: at.gauge, onGauge: (gauge) => remember({ gauge }), leaving: leaving.signal });
  const study = new StudyForm(leaving.signal);
  const budgets = new Budgets({ name: at.budget, onName: (budget) => remember({ budget }), leaving: leaving.signal });
  main.replaceChildren(h('div.desk.gauges', h('h1', { tabindex: -1 }, t('view.gauges')), calibrations.element, study.element, budgets.element));
  return () => leaving.abort();
}
