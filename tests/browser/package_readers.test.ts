import { createHash } from 'node:crypto';
import { join } from 'node:path';
import { createRequire } from 'node:module';
import { build } from 'esbuild';
import { createDecoderModule } from 'draco3d';
import { describe, expect, test } from 'vitest';
import { decodeWeights } from '@protocol/weights_format.ts';
import { readRig } from '@protocol/rig_document.ts';
import { root } from './support/paths.ts';
import { patience } from './support/patience.ts';
import type { FaceReport } from './pages/read_face.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

async function artefact(name: string): Promise<Uint8Array> {
  // Uncompressed: the ETag of a compressed answer carries the coding beside the hash.
  const response = await fetch(`${server.url}/v1/models/sample/${name}`, { headers: { 'Accept-Encoding': 'identity' } });
  expect(response.status).toBe(200);
  const bytes = new Uint8Array(await response.arrayBuffer());
  expect(response.headers.get('ETag')).toBe(`"sha256-${createHash('sha256').update(bytes).digest('hex')}"`);
  return bytes;
}

describe('face package, read by others', () => {
  test('MeshDrc_NpmDraco3d_DecodesWhatTheRigAnnounces', async () => {
    const draco = (await createDecoderModule({})) as any; // eslint-disable-line @typescript-eslint/no-explicit-any
    const bytes = await artefact('mesh.drc');
    const rig = readRig(new TextDecoder().decode(await artefact('rig.json')));
    const decoder = new draco.Decoder();
    const buffer = new draco.DecoderBuffer();
    buffer.Init(new Int8Array(bytes), bytes.length);
    expect(decoder.GetEncodedGeometryType(buffer)).toBe(draco.TRIANGULAR_MESH);
    const mesh = new draco.Mesh();
    const status = decoder.DecodeBufferToMesh(buffer, mesh);
    expect(status.ok(), status.error_msg()).toBe(true);
    expect([mesh.num_points(), mesh.num_faces()]).toEqual([rig.mesh.vertices, rig.mesh.triangles]);

    const floats = (id: number): Float32Array => {
      const array = new draco.DracoFloat32Array();
      decoder.GetAttributeFloatForAllPoints(mesh, decoder.GetAttributeByUniqueId(mesh, id), array);
      return Float32Array.from({ length: array.size() }, (_, i) => array.GetValue(i));
    };
    const positions = floats(rig.mesh.attributes.position);
    expect(positions).toHaveLength(rig.mesh.vertices * 3);
    positions.forEach((value, i) => {
      const axis = i % 3;
      const slack = (rig.bounds.max[axis]! - rig.bounds.min[axis]!) * 1e-3;
      if (!(value >= rig.bounds.min[axis]! - slack && value <= rig.bounds.max[axis]! + slack))
        throw new Error(`position ${i} is ${value}`);
    });
    const normals = floats(rig.mesh.attributes.normal!);
    for (let v = 0; v < normals.length; v += 3)
      expect(Math.abs(Math.hypot(normals[v]!, normals[v + 1]!, normals[v + 2]!) - 1)).toBeLessThan(0.01);
    const face = new draco.DracoInt32Array();
    let highest = 0;
    for (let i = 0; i < mesh.num_faces(); i += 1) {
      decoder.GetFaceFromMesh(mesh, i, face);
      for (let k = 0; k < 3; k += 1) highest = Math.max(highest, face.GetValue(k));
    }
    expect(highest).toBe(rig.mesh.vertices - 1);
    for (const point of rig.feature_points) {
      if (point.vertex === null) continue;
      const at = positions.subarray(point.vertex * 3, point.vertex * 3 + 3);
      point.position.forEach((value, axis) =>
        expect(Math.abs(value - at[axis]!), point.id).toBeLessThan(
          (rig.bounds.max[axis]! - rig.bounds.min[axis]!) * 1e-3,
        ),
      );
    }
  });

  test('Weights_OfTheMesh_RowsAreSharesOfKnownPoints', async () => {
    const [table, mesh, rig] = [
      await decodeWeights(await artefact('weights')),
      await artefact('mesh.drc'),
      readRig(new TextDecoder().decode(await artefact('rig.json'))),
    ];
    expect(table.meshSha256).toBe(createHash('sha256').update(mesh).digest('hex'));
    expect(table.vertexCount).toBe(rig.mesh.vertices);
    let led = 0;
    for (let v = 0; v < table.vertexCount; v += 1) {
      let sum = 0;
      for (let k = table.rowOffsets[v]!; k < table.rowOffsets[v + 1]!; k += 1) {
        expect(table.rowPoints[k]).toBeLessThan(84);
        sum += table.rowWeights[k]!;
      }
      // The tongue follows its own points and also the jaw: a sum of at most 2, plus half a 12-bit quantum per entry.
      expect(sum).toBeLessThanOrEqual(2.002);
      if (sum > 0.5) led += 1;
    }
    // Most vertices of this head are on the face, with weights; the others fade out or have none.
    expect(led / table.vertexCount).toBeGreaterThan(0.3);
    // Eyes, irises, and the tongue with roll shares from 0 to 1.
    const motions = new Set(table.rigid);
    for (const motion of [0, 1, 2, 3, 4, 5, 6, 255]) expect(motions).toContain(motion);
    for (const motion of motions) expect(motion <= 6 || motion >= 128).toBe(true);
  });

  test('FaceGlb_GltfLoader_ReadsMeshMaterialsWeightsAndRig', async () => {
    // Bundled from the npm package of three.js; the page needs the server's origin to load the Draco decoder from it.
    const nodeModules = join(root, 'web/node_modules');
    const bundle = await build({
      entryPoints: [join(root, 'tests/browser/pages/read_face.ts')],
      bundle: true,
      format: 'esm',
      footer: { js: 'globalThis.reader = { readFace };' },
      write: false,
      nodePaths: [nodeModules],
      logLevel: 'silent',
    });
    const page = await browser.newPage();
    page.setDefaultTimeout(patience);
    const errors: string[] = [];
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    page.on('pageerror', (error) => errors.push(String(error)));
    await page.route('**/favicon.ico', (route) => route.fulfill({ status: 204 })); // a page of plain JSON names no icon
    await page.goto(`${server.url}/version`);
    await page.addScriptTag({ content: bundle.outputFiles[0]!.text, type: 'module' });
    await page.waitForFunction(() => 'reader' in window);
    const report = await page.evaluate(() =>
      (window as unknown as { reader: { readFace(url: string, draco: string): Promise<FaceReport> } }).reader.readFace(
        '/v1/models/sample/face.glb',
        '/draco/',
      ),
    );
    const rig = readRig(new TextDecoder().decode(await artefact('rig.json')));

    expect(report.primitives.length).toBeGreaterThan(1);
    expect(report.primitives.reduce((sum, one) => sum + one.triangles, 0)).toBe(rig.mesh.triangles);
    expect(report.textures).toBeGreaterThan(0);
    for (const one of report.primitives) {
      expect(one.finite).toBe(true);
      expect(one.highestIndex).toBeLessThan(one.vertices);
      expect(one.attributes).toEqual(expect.arrayContaining(['position', 'normal', '_rigid']));
      expect(one.highestPoint).toBeLessThan(84);
      expect(one.highestSum).toBeLessThanOrEqual(2.001);
    }
    // The skin has weights; rigid parts (eyes, upper teeth) need none.
    expect(
      report.primitives.some(
        (one) => one.attributes.includes('_fp_index_0') && one.attributes.includes('_fp_weight_0'),
      ),
    ).toBe(true);
    expect(Math.max(...report.primitives.map((one) => one.highestRigid))).toBe(255);
    expect(report.format).toBe('semblante.rig');
    expect(errors).toEqual([]);
    await page.close();
  });

  test('PreviewGlb_FileVertices_AreThoseOfTheModel', async () => {
    const model = (await (await fetch(`${server.url}/v1/models/sample`)).json()) as { counts: { vertices: number } };
    const points = (await (await fetch(`${server.url}/v1/models/sample/feature-points`)).json()) as {
      points: Record<string, { vertex: number | null }>;
    };
    const vertices = Object.values(points.points).flatMap((point) => (point.vertex === null ? [] : [point.vertex]));
    // All points except 7.1, the centre of rotation inside the head, are on a vertex.
    expect(vertices).toHaveLength(83);
    expect(Math.max(...vertices)).toBeLessThan(model.counts.vertices);
  });
});

// Resolved here so that a missing package fails immediately, with its name in the error.
createRequire(join(root, 'web/package.json')).resolve('three');
