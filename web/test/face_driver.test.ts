import { beforeEach, describe, expect, test } from 'vitest';
import { neutralFrame, type FaceFrame, type StreamClient, type TimedFrame } from '@client/index.ts';
import { loadLibrary } from '../../tests/unit/ts/support/runtime.ts';
import { FrameClip } from '../src/face/clip.ts';
import type { Api } from '../src/net/api.ts';
import type { Recording } from '../src/net/types.ts';
import { FaceDriver, type DrivenFace, type MotionSource } from '../src/ui/stage/face_driver.ts';
import { LiveModel } from '../src/ui/live/live_model.ts';
import { RecordingsModel } from '../src/ui/recordings/recordings_model.ts';
import type { Studio } from '../src/ui/shared/studio.ts';

const at = (time: number): TimedFrame => ({ time, state: neutralFrame() });

/** Writes down what it is told to show. */
class FakeFace implements DrivenFace {
  followed: FaceFrame[] = [];
  clipTimes: number[] = [];
  enlivened = 0;
  steps: boolean[] = [];
  client: StreamClient | null | undefined;

  readonly follow = (frame: FaceFrame): void => void this.followed.push(frame);
  readonly showBetween = (from: FaceFrame): void =>
    void this.clipTimes.push(frames.find(({ state }) => state === from)!.time);
  readonly enliven = (): void => void (this.enlivened += 1);
  readonly step = (_delta: number, live: boolean): boolean => {
    this.steps.push(live);
    return live;
  };
  readonly listen = (client: StreamClient | null): void => void (this.client = client);
}

const frames = [at(0), at(40), at(80)];
const hand = neutralFrame();
const moment = neutralFrame();
let driver: FaceDriver;
let face: FakeFace;

beforeEach(() => {
  driver = new FaceDriver(hand);
  face = new FakeFace();
  driver.setFace(face);
  driver.clip.load(new FrameClip(frames));
  face.followed = [];
});

const takes: Record<MotionSource, () => void> = {
  hand: () => driver.byHand(),
  clip: () => {
    driver.byClip();
    driver.clip.play();
  },
  speech: () => driver.bySpeech({ clip: new FrameClip(frames), now: () => 40 }),
  microphone: () => driver.byMicrophone(() => frames[1]!.state),
  recording: () => driver.byRecording(moment),
  stream: () => driver.byStream(),
};
const isHeard = (source: MotionSource): boolean => source === 'speech' || source === 'microphone';
const sources = Object.keys(takes) as MotionSource[];
const pairs = sources.flatMap((from) => sources.map((to) => [from, to] as const));

describe('face driver', () => {
  test('ClipToSave_IsTheSpeechAlsoAfterItsEnd_UntilASourceIsTakenByHand', () => {
    takes.speech();
    const speech = driver.clipToSave;
    expect(speech).not.toBeNull();
    driver.release('speech');
    expect([driver.source.value, driver.shownClip, driver.clipToSave]).toEqual(['hand', null, speech]);
    driver.byHand();
    expect(driver.clipToSave).toBeNull();
    takes.clip();
    expect(driver.clipToSave).toBe(driver.clip.clip);
  });

  test.each(sources)('Twin_While%sHasTheFace_IsMovedAlike', (source) => {
    takes[source]();
    const twin = new FakeFace();
    driver.setTwin(twin);
    expect(twin.followed).toEqual([source === 'recording' ? moment : hand]);
    driver.step(0.016);
    expect(twin.clipTimes).toEqual(face.clipTimes);
    expect(twin.steps).toEqual(face.steps);
    expect(driver.twinMoved).toBe(source !== 'hand' && source !== 'recording');
    driver.setTwin(null);
    driver.step(0.016);
    expect(driver.twinMoved).toBe(false);
    expect(face.steps.length + face.clipTimes.length).toBe(2);
    expect(twin.steps.length + twin.clipTimes.length).toBe(1);
  });

  test('Step_SpeechThatIsPaused_ChangesThePoseOnce_AgainWhenItGoesOn', () => {
    let now = 40;
    driver.bySpeech({ clip: new FrameClip(frames), now: () => now });
    expect([driver.step(0.016), driver.step(0.016)]).toEqual([true, false]);
    expect(driver.twinMoved).toBe(false);
    now = 80;
    expect([driver.step(0.016), driver.step(0.016)]).toEqual([true, false]);
    driver.setFace(face); // a new head shows the moment as well
    expect(driver.step(0.016)).toBe(true);
    expect(face.clipTimes).toEqual([40, 80, 80]);
  });

  test('Step_MicrophoneThatHearsNothingNew_ChangesThePoseOnce', () => {
    let heard = frames[0]!.state;
    driver.byMicrophone(() => heard);
    expect([driver.step(0.016), driver.step(0.016)]).toEqual([true, false]);
    heard = frames[2]!.state;
    expect([driver.step(0.016), driver.step(0.016)]).toEqual([true, false]);
    expect(face.clipTimes).toEqual([0, 80]);
  });

  test('Start_NothingYet_IsTheHand', () => expect(driver.source.value).toBe('hand'));

  test.each(pairs)('Take_From%sBy%s_HasTheFaceAlone', (from, to) => {
    takes[from]();
    takes[to]();
    expect(driver.source.value).toBe(to);
    expect(driver.clip.playing).toBe(to === 'clip');
    driver.step(0.016);
    expect(face.clipTimes).toEqual(to === 'clip' ? [0] : isHeard(to) ? [40] : []);
    expect(face.steps).toEqual(to === 'clip' || isHeard(to) ? [] : [to === 'stream']);
    if (to === 'hand') expect(face.followed.at(-1)).toBe(hand);
    if (to === 'recording') expect(face.followed.at(-1)).toBe(moment);
  });

  test.each(pairs)('Release_%sWhile%sHasTheFace_GivesItToTheHandOnlyFromItsOwner', (released, owner) => {
    takes[owner]();
    driver.release(released);
    expect(driver.source.value).toBe(released === owner ? 'hand' : owner);
  });

  test('OnTake_EachTake_IsToldAlsoWithoutAChange', () => {
    const told: MotionSource[] = [];
    driver.onTake((source) => told.push(source));
    driver.byHand();
    driver.byHand();
    driver.byStream();
    expect(told).toEqual(['hand', 'hand', 'stream']);
  });

  test.each(sources)('IdleLife_Under%s_RunsUnderTheHandAlone', async (source) => {
    await driver.setIdle(loadLibrary);
    takes[source]();
    driver.step(0.016);
    expect(face.enlivened).toBe(source === 'hand' ? 1 : 0);
  });

  test.each(sources)('IdleSwitchedOn_Under%s_GivesTheFaceToTheHand', async (source) => {
    takes[source]();
    await driver.setIdle(loadLibrary);
    expect(driver.source.value).toBe('hand');
  });

  test.each(sources)('IdleSwitchedOff_Under%s_LeavesWhatMovesByItselfAlone', async (source) => {
    takes[source]();
    await driver.setIdle(null);
    expect(driver.source.value).toBe(['clip', 'speech', 'microphone', 'stream'].includes(source) ? source : 'hand');
    driver.step(0.016);
    expect(face.enlivened).toBe(0);
  });

  test('IdleSwitchedOff_WhileItsLibraryLoads_StaysOff', async () => {
    let arrive: () => void = () => undefined;
    const loads = new Promise<void>((resolve) => (arrive = resolve));
    const switched = driver.setIdle(() => loads.then(loadLibrary));
    await driver.setIdle(null);
    arrive();
    await switched;
    takes.hand();
    driver.step(0.016);
    expect(face.enlivened).toBe(0);
  });

  test('IdleLife_WithoutItsLibrary_FailsAndStaysOff', async () => {
    await expect(driver.setIdle(() => Promise.reject(new Error('no connection')))).rejects.toThrow('no connection');
    driver.step(0.016);
    expect(face.enlivened).toBe(0);
  });

  test('Clip_Paused_KeepsTheFaceAtItsPlace', () => {
    takes.clip();
    driver.step(0.016);
    driver.clip.pause();
    driver.step(0.016);
    expect([driver.source.value, face.clipTimes]).toEqual(['clip', [0]]);
    driver.clip.seek(40);
    driver.step(0.016);
    expect(face.clipTimes).toEqual([0, 40]);
  });

  test('Clip_ReadOtherwiseWhileAnotherHasTheFace_IsNotShown', () => {
    takes.clip();
    driver.byHand();
    driver.clip.load(new FrameClip(frames), true);
    driver.step(0.016);
    expect([driver.source.value, face.clipTimes]).toEqual(['hand', []]);
  });

  test.each(sources)('NewFace_Under%s_GoesOnButForAMomentOfARecording', (source) => {
    const client = {} as StreamClient;
    driver.setClient(client);
    takes[source]();
    driver.clip.seek(40);
    driver.clip.pause();
    const other = new FakeFace();
    driver.setFace(other);
    expect(driver.source.value).toBe(source === 'recording' ? 'hand' : source);
    expect([other.client, other.followed]).toEqual([client, [hand]]);
    driver.step(0.016);
    expect(other.clipTimes).toEqual(source === 'clip' || isHeard(source) ? [40] : []);
  });

  test('NoFace_AnySource_MovesNothing', () => {
    driver.setFace(null);
    for (const take of Object.values(takes)) {
      take();
      expect(driver.step(0.016)).toBe(false);
    }
  });
});

describe('recordings and the face driver', () => {
  const recording = { id: 'r', name: 'Take' } as Recording;

  function setUp(): { model: RecordingsModel; answer: (frame: FaceFrame) => Promise<void> } {
    let resolve: (frame: FaceFrame) => void = () => undefined;
    const api = {
      recordedFrame: () => new Promise<FaceFrame>((done) => (resolve = done)),
      listRecordings: () => Promise.resolve([]),
    } as unknown as Api;
    const attempt = async (_what: string, action: () => Promise<void>): Promise<boolean> => {
      await action();
      return true;
    };
    const studio = { api, attempt } as unknown as Studio;
    const model = new RecordingsModel(studio, new LiveModel(studio, hand, driver), driver, () => undefined);
    const settled = (): Promise<void> => new Promise((wake) => setTimeout(wake));
    return { model, answer: (frame) => (resolve(frame), settled()) };
  }

  test('LookAt_MomentArrives_TakesTheFace', async () => {
    const { model, answer } = setUp();
    driver.byStream();
    void model.lookAt(recording, 1200);
    expect(driver.source.value).toBe('stream');
    await answer(moment);
    expect(driver.source.value).toBe('recording');
    expect(face.followed).toEqual([moment]);
    expect(model.look.value).toEqual({ id: 'r', at: 1200 });
  });

  test.each(['hand', 'clip', 'stream'] as const)('LookAt_%sTakesTheFaceMeanwhile_ShowsNothingLate', async (source) => {
    const { model, answer } = setUp();
    void model.lookAt(recording, 1200);
    takes[source]();
    await answer(moment);
    expect([driver.source.value, model.look.value]).toEqual([source, null]);
    expect(face.followed).not.toContain(moment);
  });
});
