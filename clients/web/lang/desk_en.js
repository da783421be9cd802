/** English of the views at a desk: overview, trend, programs, gauges; the other languages have the same names. */
export default {
  'overview.look': 'Shown as',
  'overview.look.list': 'List',
  'overview.look.heat': 'Parts by characteristic',
  'overview.look.wall': 'Small charts',
  'heat.browse': 'Parts by characteristic: the arrow keys go from value to value',
  'heat.pick': 'Touch a cell, or use the arrow keys. The newest part is at the right.',
  'heat.table': 'The same as a table',
  'heat.none': 'not measured',
  'heat.upper': 'near the upper limit',
  'heat.middle': 'in the middle',
  'heat.lower': 'near the lower limit',
  'wall.title': 'Small charts of the newest values',
};
