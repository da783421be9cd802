/** Italian of the views at a desk. */
export default {
  'overview.look': 'Mostrato come',
  'overview.look.list': 'Elenco',
  'overview.look.heat': 'Pezzi per caratteristica',
  'overview.look.wall': 'Piccole carte',
  'heat.browse': 'Pezzi per caratteristica: le frecce vanno da un valore all’altro',
  'heat.pick': 'Toccare una casella o usare le frecce. Il pezzo più recente è a destra.',
  'heat.table': 'Lo stesso come tabella',
  'heat.none': 'non misurato',
  'heat.upper': 'vicino al limite superiore',
  'heat.middle': 'al centro',
  'heat.lower': 'vicino al limite inferiore',
  'wall.title': 'Piccole carte dei valori più recenti',
};
