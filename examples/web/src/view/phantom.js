// SPDX-License-Identifier: MIT
// phantom: the glass round the balloon.
import * as three from "three";

const glass = new three.MeshPhongMaterial({
  color: 0x9fc4d8,
  specular: 0xffffff,
  shininess: 90,
  transparent: true,
  opacity: 0.2,
  side: three.DoubleSide,
  forceSinglePass: true,
  depthWrite: false,
});

function ring(radius, tube, turn, place = [0, 0, 0]) {
  const mesh = new three.Mesh(new three.TorusGeometry(radius, tube, 20, 60), glass);
  mesh.rotation.set(...turn);
  mesh.position.set(...place);
  return mesh;
}

// The six faces of the cube, each with a round window, and what is left of the ball's surface between the windows.
function hollow_cube() {
  const half = 1.15, ball = 1.36, window_radius = Math.sqrt(ball * ball - half * half);
  const square = new three.Shape();
  square.moveTo(-half, -half).lineTo(half, -half).lineTo(half, half).lineTo(-half, half).closePath();
  square.holes.push(new three.Path().absarc(0, 0, window_radius, 0, 2 * Math.PI, true));
  const face = new three.ShapeGeometry(square, 48);
  const quarter = Math.PI / 2;
  const turns = [[0, 0, 0], [0, 2 * quarter, 0], [0, quarter, 0], [0, -quarter, 0], [quarter, 0, 0], [-quarter, 0, 0]];
  return turns.map((turn) => {
    const mesh = new three.Mesh(face, glass);
    mesh.rotation.set(...turn);
    mesh.translateZ(half);
    return mesh;
  });
}

const quarter = Math.PI / 2;
const parts = {
  rings: () => [ring(1.02, 0.3, [quarter, 0, 0]), ring(1.02, 0.3, [0, quarter, 0])],
  frame: hollow_cube,
  chain: () => [-1, 0, 1].map((x) => ring(0.55, 0.19, [0, 0, 0], [x, 0, 0])),
};

export function phantom(name) {
  const group = new three.Group();
  group.add(...parts[name]());
  return group;
}
