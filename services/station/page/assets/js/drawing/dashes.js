// A dashed line: short rods along a way.

import { CylinderGeometry, Group, InstancedMesh, Object3D, Vector3 } from "/assets/js/drawing/three.js";
import { plain } from "/assets/js/drawing/paint.js";

const RADIUS_M = 0.0045;
const AT_MOST = 160;
const UP = new Vector3(0, 1, 0);

export class Dashes {
  constructor(colour, { dash = 0.016, gap = 0.012, radius = RADIUS_M } = {}) {
    Object.assign(this, { dash, gap });
    this.root = new Group();
    this.rods = new InstancedMesh(new CylinderGeometry(radius, radius, 1, 6), plain(colour), AT_MOST);
    this.rods.frustumCulled = false;
    this.rod = new Object3D();
    this.root.add(this.rods);
    this.hide();
  }

  hide() {
    this.root.visible = false;
  }

  // points: [x, y, z] along the way.
  show(points) {
    const ends = endsOf(points, this.dash, this.gap).slice(0, AT_MOST);
    ends.forEach(([from, to], i) => {
      const along = to.clone().sub(from);
      const length = along.length();
      this.rod.position.copy(from).addScaledVector(along, 0.5);
      this.rod.quaternion.setFromUnitVectors(UP, along.divideScalar(length));
      this.rod.scale.set(1, length, 1);
      this.rod.updateMatrix();
      this.rods.setMatrixAt(i, this.rod.matrix);
    });
    this.rods.count = ends.length;
    this.rods.instanceMatrix.needsUpdate = true;
    this.root.visible = ends.length > 0;
  }
}

// Where the dashes begin and end.
function endsOf(points, dash, gap) {
  const ends = [];
  let [begun, left] = [null, 0];
  for (let i = 1; i < points.length; i += 1) {
    const [from, to] = [new Vector3().fromArray(points[i - 1]), new Vector3().fromArray(points[i])];
    const length = from.distanceTo(to);
    let passed = 0;
    while (passed + left < length) {
      passed += left;
      const here = from.clone().lerp(to, passed / length);
      if (begun) ends.push([begun, here]);
      [begun, left] = begun ? [null, gap] : [here, dash];
    }
    left -= length - passed;
  }
  const end = points.length > 1 ? new Vector3().fromArray(points.at(-1)) : null;
  if (begun && end.distanceTo(begun) > dash / 4) ends.push([begun, end]);
  return ends;
}
