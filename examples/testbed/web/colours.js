// SPDX-License-Identifier: MIT
// Colour scales. `viridis` is sampled from the scale of that name by S. van der Walt and N. Smith (CC0).

const viridis = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
  [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
];
const stones = [
  [176, 164, 148], [158, 149, 137], [190, 178, 160], [148, 143, 138], [170, 155, 135], [182, 173, 163],
];

/** Writes the colour of t in [0, 1] into out[at..at+2]; components in [0, 1], sRGB. */
export function scaleColour(t, out, at) {
  const x = Math.min(1, Math.max(0, Number.isFinite(t) ? t : 1)) * (viridis.length - 1);
  const k = Math.min(viridis.length - 2, Math.floor(x));
  for (let c = 0; c < 3; ++c)
    out[at + c] = (viridis[k][c] + (x - k) * (viridis[k + 1][c] - viridis[k][c])) / 255;
}
export function stoneColour(k, out, at) {
  for (let c = 0; c < 3; ++c) out[at + c] = stones[k % stones.length][c] / 255;
}
/** A CSS gradient of the scale. */
export const scaleGradient = `linear-gradient(to right, ${viridis.map((c) => `rgb(${c})`).join(", ")})`;
