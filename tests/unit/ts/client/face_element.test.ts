import { afterEach, expect, test, vi } from 'vitest';
import type { RigDocument, Vec3 } from '../../../../protocol/ts/index.ts';
import { budgetOf, cheaperSteps, firstVertices, type Device } from '../../../../clients/js/element/detail.ts';
import { fewerPixels, Pace } from '../../../../clients/js/view/pace.ts';
import { expectIds, faceOf, Images, modelOf, serverOf } from '../../../../clients/js/element/loader.ts';
import { FaceTrouble, isPassing } from '../../../../clients/js/element/words.ts';
import { OrbitCamera } from '../../../../clients/js/view/camera.ts';
import { frameOf } from '../../../../clients/js/view/framing.ts';

const phone: Device = { softwareRenderer: false, cores: 8, memory: 6, handheld: true, savesData: false };

test('budgetOf_WeakDevices_GetFewerVerticesAndNoShadow', () => {
  const strong = budgetOf({ ...phone, handheld: false }, 'auto');
  expect(strong.render.shadows).toBe(true);
  for (const weak of [{ softwareRenderer: true }, { cores: 2 }, { memory: 1 }]) {
    const { render, maxVertices } = budgetOf({ ...phone, ...weak }, 'auto');
    expect(render.shadows).toBe(false);
    expect(maxVertices).toBe(firstVertices);
  }
  expect(budgetOf(phone, 'auto').maxVertices).toBeGreaterThan(firstVertices);
  expect(budgetOf({ ...phone, savesData: true }, 'auto').maxVertices).toBe(firstVertices);
  expect(budgetOf({ ...phone, cores: 1 }, 'high').render.shadows).toBe(true);
});

/** The steps that a device takes that needs so long for a picture, s, over a time, s. */
function steps(pace: Pace, picture: number, seconds: number, smaller: boolean, larger: boolean): string[] {
  const taken: string[] = [];
  for (let time = 0; time < seconds; time += picture) {
    const step = pace.tick(picture, picture / 4, smaller, larger);
    if (step) taken.push(step);
  }
  return taken;
}

const usual = cheaperSteps(budgetOf(phone, 'auto').render, 3);

test('Pace_Below30PerSecond_DrawsPlainerThenSmaller', () => {
  // 2 a second: a software renderer, for which every picture is a gap.
  for (const slow of [1 / 20, 1 / 2]) {
    expect(steps(new Pace(usual), slow, 30, true, false).slice(0, 4)).toEqual(['fewer-pixels', 'plainer', 'fewer-pixels', 'smaller']);
    expect(steps(new Pace(usual), slow, 30, false, false)).toEqual(['fewer-pixels', 'plainer', 'fewer-pixels']);
  }
  expect(steps(new Pace(usual), 1 / 31, 30, true, false)).toEqual([]);
});

test('cheaperSteps_WeakDevice_TakesNoStepThatChangesNothing', () => {
  const { render } = budgetOf({ ...phone, cores: 1 }, 'auto');
  expect(cheaperSteps(render, 3)).toEqual(['fewer-pixels']);
  expect(cheaperSteps(render, 1)).toEqual(['fewer-pixels']);
  expect([fewerPixels(2), fewerPixels(1)]).toEqual([1, 0.6]);
});

test('Pace_AtFullRate_TriesALargerLevel_AndLaterAndLaterAfterItWasTooSlow', () => {
  const pace = new Pace(usual);
  expect(steps(pace, 1 / 60, 12, true, true)[0]).toBe('larger');
  expect(steps(pace, 1 / 20, 5, true, true)[0]).toBe('smaller');
  expect(steps(pace, 1 / 60, 10, true, true)).toEqual([]);
  expect(steps(pace, 1 / 60, 10, true, true)).toEqual(['larger']);
});

test('Pace_HiddenPage_IsNoSlowDevice', () => {
  const pace = new Pace(usual);
  for (let i = 0; i < 200; i += 1) expect(pace.tick(i % 3 === 0 ? 0.5 : 1 / 60, 0.001, true, false)).toBeNull();
});

/** A standing body of 1.8 with the feature points of a head. */
function body(points: Record<string, Vec3>): RigDocument {
  return {
    bounds: { min: [-0.6, 0, -0.3], max: [0.6, 1.8, 0.3] },
    feature_points: Object.entries(points).map(([id, position]) => ({ id, vertex: 0, position })),
  } as unknown as RigDocument;
}

test('frameOf_ABody_ShowsItsHead', () => {
  const rig = body({ '3.5': [0.03, 1.68, 0.08], '3.6': [-0.03, 1.68, 0.08], '2.1': [0, 1.57, 0.08], '11.4': [0, 1.79, 0] });
  const { centre, half } = frameOf(rig, 'head');
  expect(centre[1] + half[1]).toBeLessThan(1.8001);
  expect(centre[1] + half[1]).toBeGreaterThanOrEqual(1.79);
  expect(centre[1] - half[1]).toBeLessThan(1.57);
  expect(centre[1] - half[1]).toBeGreaterThan(1.5);
  expect(half[0]).toBeLessThan(0.2);
  expect(frameOf(rig, 'face').half[1]).toBeLessThan(half[1]);
  expect(frameOf(rig, 'model').half[1]).toBeCloseTo(0.9);
});

test('frameOf_WithoutEyesOrChin_ShowsTheModel', () => {
  expect(frameOf(body({}), 'head').half[1]).toBeCloseTo(0.9);
  expect(frameOf(body({ '3.5': [0, 1, 0], '2.1': [0, 1.2, 0] }), 'head').half[1]).toBeCloseTo(0.9);
});

/** Where a point of the model lies in the picture, -1..1. */
function project({ matrix: m }: OrbitCamera, [x, y, z]: Vec3): number[] {
  const row = (i: number): number => m[i]! * x + m[4 + i]! * y + m[8 + i]! * z + m[12 + i]!;
  return [0, 1, 2].map((i) => row(i) / row(3));
}

test('OrbitCamera_PortraitAndLandscape_FillThePictureWithTheWholeSubject', () => {
  const camera = new OrbitCamera();
  camera.subject = { centre: [1, 2, 3], half: [0.4, 0.5, 0.4] };
  for (const aspect of [390 / 844, 844 / 390, 1]) {
    camera.update(aspect);
    const [right, top] = project(camera, [1.4, 2.5, 3]);
    expect(Math.max(right!, top!)).toBeGreaterThan(0.75);
    expect(Math.max(right!, top!)).toBeLessThanOrEqual(1);
    const [x, y, depth] = project(camera, [1, 2, 3]);
    expect([x, y].map((v) => Math.abs(v!) < 1e-5)).toEqual([true, true]);
    expect(Math.abs(depth!)).toBeLessThan(1);
  }
});

test('OrbitCamera_Orbit_TurnsAboutTheSubject_AndStopsBeforeThePoles', () => {
  const camera = new OrbitCamera();
  camera.update(1);
  const distance = camera.eye[2];
  camera.orbit(Math.PI / 2, 0);
  camera.update(1);
  expect(camera.eye[0]).toBeCloseTo(distance);
  expect(camera.eye[2]).toBeCloseTo(0);
  camera.orbit(0, 10);
  expect(camera.pitch).toBeLessThan(Math.PI / 2);
  camera.reset();
  expect([camera.yaw, camera.pitch, camera.distance]).toEqual([0, 0, 1]);
});

test('serverOf_AnAddressOrAPath_IsTheServer', () => {
  const page = 'https://site.example/rooms/1.html';
  expect(serverOf('', page)).toBe('https://site.example');
  expect(serverOf('http://127.0.0.1:8080', page)).toBe('http://127.0.0.1:8080');
  expect(serverOf('HTTPS://Faces.example/semblante//', page)).toBe('https://faces.example/semblante');
  expect(serverOf('/semblante/', page)).toBe('https://site.example/semblante');
  expect(serverOf('//faces.example', page)).toBe('https://faces.example');
  expect(serverOf('http://[::1]:8080', page)).toBe('http://[::1]:8080');
});

test('serverOf_WhatIsNoServer_IsRefusedInWords_AndNotRequested', () => {
  const refused = ['javascript:alert(1)', ' java\nscript:alert(1)', 'data:text/html,<script>alert(1)</script>', 'blob:https://site.example/1', 'file:///etc/passwd',
    'ws://faces.example', 'https://', 'https://user:secret@faces.example', 'https://faces.example/?a=1', 'https://faces.example/#a'];
  for (const src of refused) {
    const trouble = catchOf(() => serverOf(src, 'https://site.example/'));
    expect(trouble, src).toBeInstanceOf(FaceTrouble);
    expect((trouble as FaceTrouble).message).toContain('is not the address of a server');
    expect(isPassing((trouble as FaceTrouble).code)).toBe(false);
  }
  expect((catchOf(() => serverOf('', 'about:blank')) as FaceTrouble).message).toContain('about:blank');
  expect((catchOf(() => serverOf(`javascript:${'x'.repeat(1e6)}`, 'about:blank')) as FaceTrouble).message.length).toBeLessThan(300);
});

test('expectIds_HalfACharacter_IsNoId', () => {
  for (const id of ['demo', '../..', 'javascript:alert(1)', '😀']) expectIds(id, id);
  expect((catchOf(() => expectIds('a\uD800', null)) as FaceTrouble).code).toBe('no-stream');
  expect((catchOf(() => expectIds('demo', '\uDC00')) as FaceTrouble).code).toBe('model-unready');
});

test('modelOf_AnIdThatNoStreamHas_IsAbsent_NotAFaultOfTheServer', async () => {
  const codes = new Map<number, string>();
  for (const status of [400, 404, 414, 431, 401, 403, 429, 500, 503]) {
    vi.stubGlobal('fetch', async () => new Response('{}', { status }));
    const trouble = await modelOf({ ...source, stream: 'a/../b' }, new AbortController().signal).catch((error: unknown) => error);
    codes.set(status, (trouble as FaceTrouble).code);
  }
  for (const status of [400, 404, 414, 431]) expect(codes.get(status), `${status}`).toBe('no-stream');
  for (const status of [401, 403]) expect(codes.get(status), `${status}`).toBe('private');
  for (const status of [429, 500, 503]) expect(codes.get(status), `${status}`).toBe('server');
});

/** As servers of development answer every path with their page. */
test('modelOf_PageInPlaceOfAStream_IsNoServer_AndIsNamedToTheDeveloper', async () => {
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  const asked = async (body: string, model: string | null): Promise<unknown> => {
    vi.stubGlobal('fetch', async () => new Response(body));
    return modelOf({ ...source, model }, new AbortController().signal).catch((error: unknown) => (error as FaceTrouble).code);
  };
  for (const page of ['<!doctype html>', '{}', 'null']) {
    expect(await asked(page, null)).toBe('unreachable');
    expect(await asked(page, 'sample')).toBe('unreachable');
  }
  expect(warn.mock.calls.map(([words]) => String(words).split(' ')[1])).toEqual(['https://faces.example/v1/streams/demo']);
  warn.mockRestore();
  expect(await asked('{"id":"demo","model":null}', null)).toBe('no-model');
  expect(await asked('{"id":"demo","model":"sample"}', null)).toBe('sample');
});

const source = { base: 'https://faces.example', stream: 'demo', model: null, token: null };

test('Images_OfFacesOfOnePage_AreFetchedOnce_AndAgainAfterAFailure', async () => {
  const asked: string[] = [];
  let status = 503;
  vi.stubGlobal('createImageBitmap', async () => ({}));
  vi.stubGlobal('fetch', async (address: string) => {
    asked.push(address);
    return new Response('x', { status });
  });
  const [one, other, ofAnotherServer] = [source, source, { ...source, base: 'https://other.example' }].map((from) => new Images(from, false));
  await expect(one!.get('a1')).rejects.toThrow('503');
  status = 200;
  const first = await one!.get('a1');
  expect(await other!.get('a1')).toBe(first);
  expect(await ofAnotherServer!.get('a1')).not.toBe(first);
  const address = '/v1/artefacts/a1';
  expect(asked).toEqual([source.base + address, source.base + address, `https://other.example${address}`]);
});

test('faceOf_SeveralAtOnce_IsOneRequest_AndAnotherWhenTheFirstIsTakenOffThePage', async () => {
  const answers: ((status: number) => void)[] = [];
  vi.stubGlobal('fetch', (_: string, { signal }: { signal: AbortSignal }) =>
    new Promise((resolve, reject) => {
      answers.push((status) => resolve(new Response('{}', { status })));
      signal.addEventListener('abort', () => reject(signal.reason as Error));
    }),
  );
  const never = new Promise<never>(() => undefined);
  const load = (signal: AbortSignal): Promise<unknown> =>
    faceOf(source, 'ana', { draco: never, runtime: never }, { lod: 0 }, new Images(source, false), signal).catch((error: unknown) => error);
  const [gone, stays] = [new AbortController(), new AbortController()];
  const [first, second, third] = [load(gone.signal), load(stays.signal), load(stays.signal)];
  const once = answers.length;
  expect(once).toBeGreaterThan(0);
  gone.abort();
  expect((await first) as Error).toHaveProperty('name', 'AbortError');
  await vi.waitFor(() => expect(answers.length).toBe(2 * once));
  for (const answer of answers) answer(404);
  expect(((await second) as FaceTrouble).code).toBe('model-unready');
  expect(((await third) as FaceTrouble).code).toBe('model-unready');
  expect(answers.length).toBe(2 * once);
});

test('faceOf_AFileThatTheBundlerLeftBehind_IsNotAServerThatCannotBeReached', async () => {
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  let offline = false;
  vi.stubGlobal('fetch', () => (offline ? Promise.reject(new TypeError('Failed to fetch')) : Promise.resolve(new Response('{}'))));
  const leftBehind = (): Promise<never> => {
    const missing = Promise.reject<never>(new Error('https://page.example/draco_decoder.wasm: status 404. The bundler has left this file behind'));
    missing.catch(() => undefined);
    return missing;
  };
  const load = (): Promise<unknown> =>
    faceOf(source, 'ana', { draco: leftBehind(), runtime: leftBehind() }, { lod: 0 }, new Images(source, false), new AbortController().signal).catch((error: unknown) => error);
  const trouble = (await load()) as FaceTrouble;
  expect(trouble.code).toBe('library');
  expect(isPassing(trouble.code)).toBe(true);
  await load();
  expect(warn.mock.calls).toEqual([[expect.stringContaining('draco_decoder.wasm: status 404')]]); // once
  offline = true;
  expect(((await load()) as FaceTrouble).code).toBe('unreachable');
  warn.mockRestore();
});

test('modelOf_WhatThePagesPolicyRefuses_IsNotAServerThatCannotBeReached', async () => {
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  vi.stubGlobal('fetch', () => Promise.reject(new TypeError('Failed to fetch')));
  let tell: (event: object) => void = () => undefined;
  vi.stubGlobal('document', { addEventListener: (_: string, listener: typeof tell) => (tell = listener) });
  vi.stubGlobal('location', new URL('https://page.example/'));
  vi.resetModules(); // without what other tests have watched
  const fresh = await import('../../../../clients/js/element/loader.ts');
  const code = async (): Promise<unknown> =>
    ((await fresh.modelOf({ ...source, base: 'https://faces.example', model: null }, new AbortController().signal).catch((error: unknown) => error)) as FaceTrouble).code;
  expect(await code()).toBe('unreachable');
  const violation = { blockedURI: 'https://faces.example/v1/streams/a', disposition: 'enforce', effectiveDirective: 'connect-src' };
  for (const other of [{ ...violation, disposition: 'report' }, { ...violation, effectiveDirective: 'img-src' }, { ...violation, blockedURI: 'https://other.example/' }, { ...violation, blockedURI: 'inline' }]) {
    tell(other);
    expect(await code()).toBe('unreachable');
  }
  tell(violation);
  expect(await code()).toBe('policy');
  expect(isPassing('policy')).toBe(false);
  expect(warn).toHaveBeenLastCalledWith(expect.stringContaining('needs https://faces.example in connect-src'));
  warn.mockRestore();
});

afterEach(() => {
  vi.unstubAllGlobals();
});

function catchOf(call: () => unknown): unknown {
  try {
    call();
  } catch (error) {
    return error;
  }
  return null;
}
