// A tube along a line: thin to show the line, or as wide as where it may lead.

// Positions and triangles of a tube.
// points: [x, y, z] along the line; reach: from a point, by its number, to the surface that faces a direction, [x, y, z].
export function sweep(points, reach, sides) {
  const line = points.filter((point, i) => i === 0 || distance(point, points[i - 1]) > 1e-6);
  const kept = points.map((_, i) => i).filter((i) => i === 0 || distance(points[i], points[i - 1]) > 1e-6);
  if (line.length < 2) return { positions: [], triangles: [] };
  const positions = [];
  let across = null;
  line.forEach((point, i) => {
    const along = unit(minus(line[Math.min(i + 1, line.length - 1)], line[Math.max(i - 1, 0)]));
    // Carried along the line, so that the tube does not twist.
    across = unit(off(across ?? leastAlong(along), along));
    const beside = cross(along, across);
    for (let side = 0; side < sides; side += 1) {
      const angle = (2 * Math.PI * side) / sides;
      const direction = across.map((c, k) => Math.cos(angle) * c + Math.sin(angle) * beside[k]);
      const out = reach(kept[i], direction);
      positions.push(...point.map((c, k) => c + out[k]));
    }
  });
  return { positions, triangles: trianglesOf(line.length, sides) };
}

// From the middle of an ellipsoid with these half axes to where its surface faces a direction.
export function ellipsoid(half, direction) {
  const extent = Math.hypot(...half.map((length, k) => length * direction[k]));
  return half.map((length, k) => (length * length * direction[k]) / extent);
}

export function ball(radius, direction) {
  return direction.map((c) => radius * c);
}

function trianglesOf(rings, sides) {
  const triangles = [];
  for (let ring = 0; ring < rings - 1; ring += 1) {
    for (let side = 0; side < sides; side += 1) {
      const [a, b] = [ring * sides + side, ring * sides + ((side + 1) % sides)];
      triangles.push(a, b, a + sides, b, b + sides, a + sides);
    }
  }
  for (const first of [0, (rings - 1) * sides]) {
    for (let side = 1; side < sides - 1; side += 1) triangles.push(first, first + side, first + side + 1);
  }
  return triangles;
}

function leastAlong(direction) {
  const sizes = direction.map(Math.abs);
  const least = sizes.indexOf(Math.min(...sizes));
  return [0, 1, 2].map((k) => (k === least ? 1 : 0));
}

function off(vector, direction) {
  const along = vector.reduce((sum, c, k) => sum + c * direction[k], 0);
  const rest = vector.map((c, k) => c - along * direction[k]);
  return Math.hypot(...rest) > 1e-6 ? rest : off(leastAlong(direction), direction);
}

function cross([ax, ay, az], [bx, by, bz]) {
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
}

function minus(a, b) {
  return a.map((c, k) => c - b[k]);
}

function unit(vector) {
  const length = Math.hypot(...vector) || 1;
  return vector.map((c) => c / length);
}

function distance(a, b) {
  return Math.hypot(...minus(a, b));
}
