import { fieldOfView } from '../gpu/studio_look.ts';

export type Vec3 = [number, number, number];

/** What a camera looks at: a box, by its centre and half sizes. */
export interface Subject {
  centre: Vec3;
  half: Vec3;
}

/** Margin around the subject, as a factor. */
const margin = 1.1;
/** Radians. */
const steepest = 1.2;
const nearest = 0.45;
const farthest = 3;

/** A camera that looks at a subject from a direction: front, turned by `yaw` and `pitch`. */
export class OrbitCamera {
  yaw = 0;
  pitch = 0;
  /** factor of the distance at which the subject fills the picture */
  distance = 1;
  subject: Subject = { centre: [0, 0, 0], half: [1, 1, 1] };
  /** Part of the picture at its lower edge, 0 to 0.5, that the subject leaves free */
  room = 0;
  readonly eye: Vec3 = [0, 0, 1];
  /** projection times view, column by column */
  readonly matrix = new Float32Array(16);

  orbit(yaw: number, pitch: number): void {
    this.yaw += yaw;
    this.pitch = Math.max(-steepest, Math.min(steepest, this.pitch + pitch));
  }

  zoom(factor: number): void {
    this.distance = Math.max(nearest, Math.min(farthest, this.distance * factor));
  }

  /** Back to the front. */
  reset(): void {
    this.yaw = this.pitch = 0;
    this.distance = 1;
  }

  /** Computes `eye` and `matrix` for a picture of this width by height. */
  update(aspect: number): void {
    const { centre, half } = this.subject;
    const slope = Math.tan((fieldOfView * Math.PI) / 360);
    const fitting = Math.max(half[1] / (1 - this.room), half[0] / aspect) * margin;
    // The subject moves up by as much as it would reach into the room.
    const lift = Math.max(0, 2 * this.room - 1 + (half[1] * margin) / fitting);
    const away = (fitting / slope + half[2] * 0.5) * this.distance;
    const back: Vec3 = [
      Math.sin(this.yaw) * Math.cos(this.pitch),
      Math.sin(this.pitch),
      Math.cos(this.yaw) * Math.cos(this.pitch),
    ];
    const right: Vec3 = [Math.cos(this.yaw), 0, -Math.sin(this.yaw)];
    const up = cross(back, right);
    for (let i = 0; i < 3; i += 1) this.eye[i] = centre[i]! + away * back[i]!;
    const size = Math.max(...half);
    const near = Math.max(away - 4 * size, size / 50);
    const far = away + 20 * size;
    const project = [1 / (slope * aspect), 1 / slope];
    const deep = [(near + far) / (near - far), (2 * near * far) / (near - far)];
    [right, up].forEach((axis, row) => {
      for (let i = 0; i < 3; i += 1) this.matrix[i * 4 + row] = project[row]! * axis[i]!;
      this.matrix[12 + row] = -project[row]! * dot(axis, this.eye);
    });
    const ahead = dot(back, this.eye);
    for (let i = 0; i < 3; i += 1) {
      this.matrix[i * 4 + 2] = deep[0]! * back[i]!;
      this.matrix[i * 4 + 3] = -back[i]!;
    }
    this.matrix[14] = -deep[0]! * ahead + deep[1]!;
    this.matrix[15] = ahead;
    for (let i = 0; i < 16; i += 4) this.matrix[i + 1]! += lift * this.matrix[i + 3]!;
  }
}

/** An orthographic camera at `eye` that sees a ball; column by column. */
export function sunMatrix(eye: Vec3, centre: Vec3, reach: number, near: number, far: number): Float32Array {
  const back = unit([eye[0] - centre[0], eye[1] - centre[1], eye[2] - centre[2]]);
  const right = unit(cross([0, 1, 0], back));
  const up = cross(back, right);
  const matrix = new Float32Array(16);
  [right, up].forEach((axis, row) => {
    for (let i = 0; i < 3; i += 1) matrix[i * 4 + row] = axis[i]! / reach;
    matrix[12 + row] = -dot(axis, eye) / reach;
  });
  // Depth -1 at `near` before the eye, 1 at `far`.
  for (let i = 0; i < 3; i += 1) matrix[i * 4 + 2] = (-2 / (far - near)) * back[i]!;
  matrix[14] = (2 / (far - near)) * dot(back, eye) - (far + near) / (far - near);
  matrix[15] = 1;
  return matrix;
}

const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export function unit(v: Vec3): Vec3 {
  const size = Math.hypot(...v) || 1;
  return [v[0] / size, v[1] / size, v[2] / size];
}
