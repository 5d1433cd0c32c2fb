import {
  AmbientLight,
  AnimationMixer,
  Box3,
  BufferAttribute,
  Color,
  DirectionalLight,
  Group,
  Mesh,
  PerspectiveCamera,
  Scene,
  SkinnedMesh,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from 'three';
import { GLTFLoader, type GLTF } from 'three/addons/loaders/GLTFLoader.js';

export interface ClipReport {
  animations: string[];
  duration: number;
  channels: number;
  bones: number;
  extras: Record<string, unknown>;
}

let gltf: GLTF;
let mixer: AnimationMixer;
/** The clip's meshes in the order of its primitives. */
let skinned: SkinnedMesh[] = [];
let show: ((seconds: number) => void) | null = null;

/** Loads a clip as any three.js page would, without Semblante's code. */
export async function openClip(url: string): Promise<ClipReport> {
  gltf = await new GLTFLoader().loadAsync(url);
  skinned = [];
  gltf.scene.traverse((node) => node instanceof SkinnedMesh && skinned.push(node));
  mixer = new AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations[0]!).play();
  return {
    animations: gltf.animations.map((clip) => clip.name),
    duration: gltf.animations[0]!.duration,
    channels: gltf.animations[0]!.tracks.length,
    bones: skinned[0]!.skeleton.bones.length,
    extras: (gltf.asset as { extras: { semblante: Record<string, unknown> } }).extras.semblante,
  };
}

/** Vertex positions of each primitive at that time, as three.js computes them: x, y, z, ... */
export function positionsAt(seconds: number): number[][] {
  seek(seconds);
  const at = new Vector3();
  return skinned.map((mesh) => {
    const out: number[] = [];
    for (let v = 0; v < mesh.geometry.getAttribute('position').count; v += 1)
      out.push(...mesh.localToWorld(mesh.getVertexPosition(v, at)).toArray());
    return out;
  });
}

/** Draws the clip at that time on the left and the given vertices (x, y, z of each primitive) on the right. */
export function drawBeside(seconds: number, vertices: number[][]): void {
  show ??= openStage();
  ours.clear();
  skinned.forEach((mesh, i) => {
    const geometry = mesh.geometry.clone();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(vertices[i]!), 3));
    ours.add(new Mesh(geometry, mesh.material));
  });
  show(seconds);
}

const ours = new Group();

function seek(seconds: number): void {
  mixer.setTime(Math.min(seconds, gltf.animations[0]!.duration - 1e-6)); // at exactly its end an action restarts
  gltf.scene.updateMatrixWorld(true);
}

function openStage(): (seconds: number) => void {
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.setSize(800, 440);
  document.body.style.margin = '0';
  document.body.append(renderer.domElement);
  const scene = new Scene();
  scene.background = new Color(0x8c939c);
  const sun = new DirectionalLight(0xffffff, 2.2);
  scene.add(gltf.scene, ours, new AmbientLight(0xffffff, 0.9), sun);
  const box = new Box3();
  for (const mesh of skinned) box.expandByObject(new Mesh(mesh.geometry));
  const size = box.getSize(new Vector3());
  const center = box.getCenter(new Vector3());
  sun.position.set(size.x * 2, size.y * 2, size.z * 4);
  gltf.scene.position.x = -0.6 * size.x - center.x;
  ours.position.x = 0.6 * size.x - center.x;
  const camera = new PerspectiveCamera(26, 800 / 440, size.y * 0.05, size.y * 20);
  camera.position.set(0, center.y, center.z + size.y * 2.9);
  camera.lookAt(0, center.y, center.z);
  return (seconds) => {
    seek(seconds);
    renderer.render(scene, camera);
  };
}
