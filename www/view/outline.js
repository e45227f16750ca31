/** A cutter's outline for drawing, from the numbers of its form; the planner has its own for computing. */

/** Steps of the corner's arc in a drawing. */
const ARC_STEPS = 12;

/**
 * Points (radius, height) from the tip to the top, millimetres; `null` if the numbers make no cutter.
 *
 * @param {any} cutter
 * @returns {[number, number][] | null}
 */
export function outline(cutter) {
  const radius = cutter?.diameter_mm / 2;
  const corner = cutter?.kind === 'ball' ? radius : (cutter?.corner_radius_mm ?? 0);
  const height = Math.max(cutter?.height_mm ?? 4 * radius, corner);
  const rise = ((cutter?.bottom_angle_deg ?? 0) * Math.PI) / 180;
  const taper = ((cutter?.taper_deg ?? 0) * Math.PI) / 180;
  if (!(radius > 0 && corner >= 0 && corner <= radius * 1.0001 && height > 0 && Number.isFinite(height)))
    return null;
  // Where the corner touches both the bottom line, which rises, and the side line, which leans.
  const bend = 1 - Math.tan(rise) * Math.tan(taper);
  const center = Math.max(
    radius - (corner * (1 / Math.cos(taper) - Math.tan(taper) / Math.cos(rise))) / bend,
    0,
  );
  const up = corner / Math.cos(rise) + center * Math.tan(rise);
  /** @type {[number, number][]} */
  const points = [[0, 0]];
  for (let i = 0; i <= ARC_STEPS; i += 1) {
    const angle = rise + ((Math.PI / 2 - taper - rise) * i) / ARC_STEPS;
    points.push([center + corner * Math.sin(angle), up - corner * Math.cos(angle)]);
  }
  const [side, low] = points[points.length - 1];
  points.push([side + Math.max(height - low, 0) * Math.tan(taper), Math.max(height, low)]);
  return points;
}
