/** What goes first when workers are scarce. */
export const URGENCY = {
  fate: 0,
  discovery: 1,
  soonDone: 2,
  map: 3,
  starts: 3,
  sweep: 4,
  comparison: 4,
  bare: 2,
  figures: 3,
  held: 4,
  changes: 4,
} as const;
