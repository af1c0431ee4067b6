// The robot: links that hang on one another, moved by its joints; or a point that has none.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "/assets/js/drawing/three.js";
import { plain, solid } from "/assets/js/drawing/paint.js";

export class Robot {
  constructor({ links, meshes, rest, point }, shapes) {
    this.root = new Group();
    this.moving = [];
    this.tip = null;
    if (point !== null) this.root.add((this.tip = new Mesh(new SphereGeometry(point, 20, 12), plain("ink"))));
    const solids = readMeshes(meshes, shapes);
    this.links = [];
    for (const link of links) {
      const group = linkOf(link, solids);
      (this.links[link.parent] ?? this.root).add(group);
      this.links.push(group);
      if (link.joint >= 0) this.moving.push(jointOf(link, group));
    }
    this.move(rest);
  }

  // Joint positions in the order of the description [rad, m]; what is not a number leaves its joint where it is.
  move(positions) {
    for (const { joint, group, axis, origin, turned, slides } of this.moving) {
      const value = positions[joint];
      if (!Number.isFinite(value)) continue;
      if (slides) group.position.copy(axis).multiplyScalar(value).applyQuaternion(turned).add(origin);
      else group.quaternion.setFromAxisAngle(axis, value).premultiply(turned);
    }
  }

  // A robot that is a point is where its grasping frame is.
  follow(position) {
    this.tip?.position.copy(position);
  }
}

function jointOf({ joint, axis, slides }, group) {
  const [x, y, z] = axis;
  return {
    joint,
    group,
    slides,
    axis: new Vector3(x, y, z).normalize(),
    origin: group.position.clone(),
    turned: group.quaternion.clone(),
  };
}

function linkOf(link, solids) {
  const group = new Group();
  group.name = link.name;
  place(group, link);
  for (const part of link.parts) {
    const mesh = new Mesh(formOf(part, solids), solid(part.colour));
    place(mesh, part);
    // Of a cylinder the axis is z here, and y in the library.
    if (part.cylinder) mesh.quaternion.multiply(new Quaternion(Math.SQRT1_2, 0, 0, Math.SQRT1_2));
    group.add(mesh);
  }
  return group;
}

function formOf({ mesh, box, cylinder }, solids) {
  if (box) return new BoxGeometry(...box);
  if (cylinder) return new CylinderGeometry(cylinder[0], cylinder[0], cylinder[1], 24);
  return solids[mesh];
}

// Positions and orientations come as arrays, quaternions with the scalar first.
export function place(object, { position, orientation }) {
  object.position.fromArray(position);
  const [w, x, y, z] = orientation;
  object.quaternion.set(x, y, z, w);
}

// All vertices, then all triangles, then all normals; see the description in the station.
function readMeshes(meshes, shapes) {
  const total = (name) => meshes.reduce((sum, mesh) => sum + mesh[name], 0);
  const vertices = new Uint16Array(shapes, 0, 3 * total("vertices"));
  const triangles = new Uint16Array(shapes, vertices.byteLength, 3 * total("triangles"));
  const normals = new Int8Array(shapes, vertices.byteLength + triangles.byteLength, 3 * total("vertices"));
  let vertex = 0;
  let triangle = 0;
  return meshes.map(({ corner, step, vertices: count, triangles: faces }) => {
    const [from, to] = [3 * vertex, 3 * (vertex + count)];
    const geometry = new BufferGeometry();
    const places = Float32Array.from(vertices.subarray(from, to), (whole, i) => corner[i % 3] + step[i % 3] * whole);
    const directions = Float32Array.from(normals.subarray(from, to), (whole) => whole / 127);
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setAttribute("normal", new BufferAttribute(directions, 3));
    geometry.setIndex(new BufferAttribute(triangles.slice(3 * triangle, 3 * (triangle + faces)), 1));
    vertex += count;
    triangle += faces;
    return geometry;
  });
}
