/** How colours look to people without one kind of cone, and how far apart two of them are. */

const linear = (channel) => (channel <= 0.04045 ? channel / 12.92 : ((channel + 0.055) / 1.055) ** 2.4);

/** "rgb(1, 2, 3)" as linear sRGB. */
export const parseColour = (text) => text.match(/[\d.]+/g).slice(0, 3).map((value) => linear(Number(value) / 255));

const times = (matrix, vector) => matrix.map((row) => row.reduce((sum, factor, i) => sum + factor * vector[i], 0));

// Machado, Oliveira and Fernandes 2009, severity 1.0, for linear sRGB.
const DEUTERANOPIA = [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]];
const PROTANOPIA = [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]];

export const asSeenWith = { deuteranopia: (colour) => times(DEUTERANOPIA, colour), protanopia: (colour) => times(PROTANOPIA, colour) };

/** CIE L*a*b*, white point D65. */
function lab(colour) {
  const xyz = times([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]], colour);
  const [x, y, z] = xyz.map((value, i) => {
    const ratio = value / [0.95047, 1, 1.08883][i];
    return ratio > 216 / 24389 ? Math.cbrt(ratio) : (ratio * 24389 / 27 + 16) / 116;
  });
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** CIE 1976 difference; about 2 is just noticed side by side. */
export const difference = (one, other) => Math.hypot(...lab(one).map((value, i) => value - lab(other)[i]));
