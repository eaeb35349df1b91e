// SPDX-License-Identifier: MIT
// stage: camera, light and ground.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

const home = [1.2, 1.7, 7.6];

export class Stage {
  #drawn_from = new three.Vector3();

  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.toneMapping = three.NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.shadowMap.enabled = true;
    this.scene = new three.Scene();
    const environment = new three.PMREMGenerator(this.renderer);
    this.scene.environment = environment.fromScene(new RoomEnvironment(), 0.04).texture;
    this.scene.environmentIntensity = 0.55;
    environment.dispose();

    const sun = new three.DirectionalLight(0xfff1e0, 2.1);
    sun.position.set(3, 6, 4);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.radius = 6;
    sun.shadow.normalBias = 0.03;
    Object.assign(sun.shadow.camera, { left: -4, right: 4, top: 4, bottom: -4, near: 1, far: 14 });
    const rim = new three.DirectionalLight(0xbfdcff, 1.2);
    rim.position.set(-4, 1.5, -5);
    this.scene.add(sun, rim);

    const ground = new three.Mesh(new three.CircleGeometry(7, 64), new three.ShadowMaterial({ opacity: 0.16 }));
    ground.rotation.x = -Math.PI / 2;
    ground.position.y = -2;
    ground.receiveShadow = true;
    this.scene.add(ground);

    this.camera = new three.PerspectiveCamera(34, 1, 0.1, 60);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.enablePan = false;
    this.controls.minDistance = 2.5;
    this.controls.maxDistance = 16;
    this.reset_view();
    this.resize();
  }

  reset_view() {
    this.view = home;
  }

  /** The place of the camera: three numbers. */
  get view() {
    return this.camera.position.toArray();
  }

  set view(place) {
    this.camera.position.fromArray(place);
    this.controls.update();
  }

  resize() {
    const { innerWidth: width, innerHeight: height } = window;
    this.#drawn_from.setScalar(Infinity);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    // The panel covers a side or the bottom: the middle of the picture lies in the rest.
    const narrow = width <= 720;
    this.offset = narrow ? [0, 0.16 * height] : [Math.min(145, 0.12 * width), 0];
    this.camera.aspect = width / height;
    // A tall picture is as wide as the scene.
    this.camera.fov = Math.max(34, Math.min(75, (360 / Math.PI) * Math.atan((0.34 * height) / width)));
    this.camera.setViewOffset(width, height, this.offset[0], this.offset[1], width, height);
    this.camera.updateProjectionMatrix();
  }

  /** The middle of the free part of the picture, in pixels. */
  get middle() {
    return [window.innerWidth / 2 - this.offset[0], window.innerHeight / 2 - this.offset[1]];
  }

  turn(right, up) {
    const place = new three.Spherical().setFromVector3(this.camera.position);
    place.theta += right;
    place.phi = Math.max(0.1, Math.min(Math.PI - 0.1, place.phi - up));
    this.view = new three.Vector3().setFromSpherical(place).toArray();
  }

  zoom(by) {
    const length = Math.max(2.5, Math.min(16, this.camera.position.length() * by));
    this.view = this.camera.position.clone().setLength(length).toArray();
  }

  /** The ray under a pixel: origin and direction. */
  ray(x, y) {
    const { innerWidth: width, innerHeight: height } = window;
    const caster = new three.Raycaster();
    this.camera.updateMatrixWorld();
    caster.setFromCamera(new three.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera);
    return { origin: caster.ray.origin.toArray(), direction: caster.ray.direction.toArray() };
  }

  /** The pixel of a point, or null behind the camera. */
  pixel(point) {
    const p = new three.Vector3(...point).project(this.camera);
    if (p.z > 1) return null;
    return [((p.x + 1) / 2) * window.innerWidth, ((1 - p.y) / 2) * window.innerHeight];
  }

  /** Where the ray meets the plane through a point that faces the camera. */
  on_plane({ origin, direction }, point) {
    const normal = this.camera.getWorldDirection(new three.Vector3()).toArray();
    let above = 0, along = 0;
    for (let k = 0; k < 3; ++k) {
      above += (point[k] - origin[k]) * normal[k];
      along += direction[k] * normal[k];
    }
    return origin.map((x, k) => x + (above / along) * direction[k]);
  }

  /** Right and up in the picture, as directions. */
  get axes() {
    const right = new three.Vector3(), up = new three.Vector3();
    this.camera.matrixWorld.extractBasis(right, up, new three.Vector3());
    return { right: right.toArray(), up: up.toArray() };
  }

  /** Draws, if the surface or the view has changed. */
  draw(changed) {
    const turned = this.controls.update() || !this.camera.position.equals(this.#drawn_from);
    if (!changed && !turned) return;
    this.#drawn_from.copy(this.camera.position);
    this.renderer.render(this.scene, this.camera);
  }
}
