// Generated from core/bridges/data/arkit.json by semblante-codegen-bridges; change the data, not this.

/** mirror: index of the shape of the other side. faps: [FAP, FAP units at coefficient 1]. cost: mm^2. */
export interface ArkitShape {
  name: string;
  mirror: number;
  cost: number;
  faps: readonly (readonly [number, number])[];
}

export const arkitSettings = {
  carried_when_shut: 0.25,
  eye_full_turn_degrees: 35,
  lip_overlap: 160,
  tongue_parting: 0.2,
  upper_lid_share: 0.98,
  /** IRISD, ES, ENS, MNS, MW on a usual head, whole units */
  millimetres: [11, 64, 48, 21, 51],
} as const;

export const arkitRotationNames = [
  'headYaw',
  'headPitch',
  'headRoll',
  'leftEyeYaw',
  'leftEyePitch',
  'leftEyeRoll',
  'rightEyeYaw',
  'rightEyePitch',
  'rightEyeRoll',
] as const;

// prettier-ignore
export const arkitShapes: readonly ArkitShape[] = [
  { name: 'eyeBlinkLeft', mirror: 7, cost: 0, faps: [] },
  { name: 'eyeLookDownLeft', mirror: 8, cost: 0, faps: [] },
  { name: 'eyeLookInLeft', mirror: 9, cost: 0, faps: [] },
  { name: 'eyeLookOutLeft', mirror: 10, cost: 0, faps: [] },
  { name: 'eyeLookUpLeft', mirror: 11, cost: 0, faps: [] },
  { name: 'eyeSquintLeft', mirror: 12, cost: 0, faps: [[19, 110], [21, 230], [41, 40]] },
  { name: 'eyeWideLeft', mirror: 13, cost: 0, faps: [[19, -324], [21, 31]] },
  { name: 'eyeBlinkRight', mirror: 0, cost: 0, faps: [] },
  { name: 'eyeLookDownRight', mirror: 1, cost: 0, faps: [] },
  { name: 'eyeLookInRight', mirror: 2, cost: 0, faps: [] },
  { name: 'eyeLookOutRight', mirror: 3, cost: 0, faps: [] },
  { name: 'eyeLookUpRight', mirror: 4, cost: 0, faps: [] },
  { name: 'eyeSquintRight', mirror: 5, cost: 0, faps: [[20, 110], [22, 230], [42, 40]] },
  { name: 'eyeWideRight', mirror: 6, cost: 0, faps: [[20, -324], [22, 31]] },
  { name: 'jawForward', mirror: 14, cost: 2, faps: [[14, 230], [16, 190]] },
  { name: 'jawLeft', mirror: 16, cost: 2, faps: [[6, 20], [7, -20], [15, -200], [53, 20], [54, -20]] },
  { name: 'jawRight', mirror: 15, cost: 2, faps: [[6, -20], [7, 20], [15, 200], [53, -20], [54, 20]] },
  { name: 'jawOpen', mirror: 17, cost: 0.4, faps: [[3, 680], [4, 60], [5, -850], [6, -20], [7, -20], [8, 110], [9, 110], [10, -710], [11, -710], [12, -365], [13, -365], [16, -465], [18, -420], [39, -35], [40, -35], [51, 55], [52, -850], [53, -30], [54, -30], [55, 105], [56, 105], [57, -715], [58, -715], [59, -320], [60, -320]] },
  { name: 'mouthClose', mirror: 18, cost: 0.4, faps: [[3, -94], [4, 18], [5, 922], [6, 10], [7, 10], [8, -5], [9, -5], [10, 843], [11, 843], [12, 402], [13, 402], [16, 403], [39, 24], [40, 24], [51, 15], [52, 761], [53, 15], [54, 15], [55, -7], [56, -7], [57, 738], [58, 738], [59, 333], [60, 333]] },
  { name: 'mouthFunnel', mirror: 19, cost: 0.4, faps: [[3, 181], [4, -263], [5, -400], [6, -70], [7, -70], [8, -68], [9, -68], [10, -287], [11, -287], [12, -12], [13, -12], [16, 320], [17, 306], [18, -224], [39, -54], [40, -54], [51, -293], [52, -429], [53, -69], [54, -69], [55, -166], [56, -166], [57, -283], [58, -283]] },
  { name: 'mouthPucker', mirror: 20, cost: 0.4, faps: [[4, 16], [5, 9], [6, -106], [7, -106], [8, 39], [9, 39], [10, 38], [11, 38], [12, 103], [13, 103], [16, 435], [17, 334], [18, 53], [39, -65], [40, -65], [51, -178], [52, -91], [53, -94], [54, -94], [55, -130], [56, -130], [57, -14], [58, -14], [59, 104], [60, 104]] },
  { name: 'mouthLeft', mirror: 22, cost: 2, faps: [[6, 120], [7, -120], [15, -30], [39, 25], [40, -25], [53, 120], [54, -120], [64, -15]] },
  { name: 'mouthRight', mirror: 21, cost: 2, faps: [[6, -120], [7, 120], [15, 30], [39, -25], [40, 25], [53, -120], [54, 120], [64, 15]] },
  { name: 'mouthSmileLeft', mirror: 24, cost: 0.4, faps: [[4, -92], [5, 90], [6, 140], [8, -234], [9, -49], [10, 227], [11, 54], [12, 474], [16, -21], [17, -55], [18, 102], [21, 57], [39, 84], [41, 77], [51, -84], [52, 97], [53, 143], [55, -229], [56, -27], [57, 240], [58, 38], [59, 507], [61, 35]] },
  { name: 'mouthSmileRight', mirror: 23, cost: 0.4, faps: [[4, -92], [5, 90], [7, 140], [8, -49], [9, -234], [10, 54], [11, 227], [13, 474], [16, -21], [17, -55], [18, 102], [22, 57], [40, 84], [42, 77], [51, -84], [52, 97], [54, 143], [55, -27], [56, -229], [57, 38], [58, 240], [60, 507], [62, 35]] },
  { name: 'mouthFrownLeft', mirror: 26, cost: 0.4, faps: [[4, 18], [5, -12], [6, 37], [8, 64], [9, 12], [10, -48], [11, -9], [12, -186], [17, -21], [18, 24], [39, 26], [51, 26], [53, 38], [55, 76], [56, 15], [57, -31], [58, -6], [59, -221]] },
  { name: 'mouthFrownRight', mirror: 25, cost: 0.4, faps: [[4, 18], [5, -12], [7, 37], [8, 12], [9, 64], [10, -9], [11, -48], [13, -186], [17, -21], [18, 24], [40, 26], [51, 26], [54, 38], [55, 15], [56, 76], [57, -6], [58, -31], [60, -221]] },
  { name: 'mouthDimpleLeft', mirror: 28, cost: 2, faps: [[6, 80], [12, 40], [39, -20], [53, 80], [59, 40]] },
  { name: 'mouthDimpleRight', mirror: 27, cost: 2, faps: [[7, 80], [13, 40], [40, -20], [54, 80], [60, 40]] },
  { name: 'mouthStretchLeft', mirror: 30, cost: 2, faps: [[5, -30], [6, 125], [10, -60], [12, -120], [39, 20], [52, -30], [53, 125], [57, -60], [59, -130]] },
  { name: 'mouthStretchRight', mirror: 29, cost: 2, faps: [[5, -30], [7, 125], [11, -60], [13, -120], [40, 20], [52, -30], [54, 125], [58, -60], [60, -130]] },
  { name: 'mouthRollLower', mirror: 31, cost: 2, faps: [[5, 70], [10, 50], [11, 50], [16, -190], [18, 60], [52, 150], [57, 120], [58, 120]] },
  { name: 'mouthRollUpper', mirror: 32, cost: 2, faps: [[4, 60], [8, 45], [9, 45], [17, -190], [51, 150], [55, 120], [56, 120]] },
  { name: 'mouthShrugLower', mirror: 33, cost: 2, faps: [[4, -60], [5, 150], [8, -45], [9, -45], [10, 110], [11, 110], [16, 90], [18, 260], [51, -50], [52, 190], [55, -35], [56, -35], [57, 140], [58, 140]] },
  { name: 'mouthShrugUpper', mirror: 34, cost: 2, faps: [[4, -150], [8, -110], [9, -110], [17, 90], [51, -180], [55, -140], [56, -140]] },
  { name: 'mouthPressLeft', mirror: 36, cost: 2, faps: [[4, 16], [5, 46], [8, -25], [9, -5], [10, 90], [11, 18], [12, 75], [16, 35], [17, -17], [18, 123], [39, 11], [51, 34], [52, 74], [55, 12], [57, 126], [58, 26], [59, 65]] },
  { name: 'mouthPressRight', mirror: 35, cost: 2, faps: [[4, 16], [5, 46], [8, -5], [9, -25], [10, 18], [11, 90], [13, 75], [16, 35], [17, -17], [18, 123], [40, 11], [51, 34], [52, 74], [56, 12], [57, 26], [58, 126], [60, 65]] },
  { name: 'mouthLowerDownLeft', mirror: 38, cost: 0.4, faps: [[3, 88], [5, -164], [10, -201], [11, -42], [12, -78], [16, -32], [18, -118], [52, -160], [57, -197], [58, -40], [59, -55]] },
  { name: 'mouthLowerDownRight', mirror: 37, cost: 0.4, faps: [[3, 88], [5, -164], [10, -42], [11, -201], [13, -78], [16, -32], [18, -118], [52, -160], [57, -40], [58, -197], [60, -55]] },
  { name: 'mouthUpperUpLeft', mirror: 40, cost: 0.4, faps: [[4, -140], [8, -270], [9, -50], [12, 40], [41, 60], [51, -150], [55, -290], [56, -55], [59, 45], [61, 20]] },
  { name: 'mouthUpperUpRight', mirror: 39, cost: 0.4, faps: [[4, -140], [8, -50], [9, -270], [13, 40], [42, 60], [51, -150], [55, -55], [56, -290], [60, 45], [62, 20]] },
  { name: 'browDownLeft', mirror: 42, cost: 0.4, faps: [[19, 17], [31, -47], [33, -78], [35, -18], [37, 34]] },
  { name: 'browDownRight', mirror: 41, cost: 0.4, faps: [[20, 17], [32, -47], [34, -78], [36, -18], [38, 34]] },
  { name: 'browInnerUp', mirror: 43, cost: 0.4, faps: [[19, -16], [20, -16], [21, 7], [22, 7], [31, 118], [32, 118], [33, 59], [34, 59], [35, 24], [36, 24], [37, -7], [38, -7], [63, 23]] },
  { name: 'browOuterUpLeft', mirror: 45, cost: 0.4, faps: [[31, 10], [33, 85], [35, 135]] },
  { name: 'browOuterUpRight', mirror: 44, cost: 0.4, faps: [[32, 10], [34, 85], [36, 135]] },
  { name: 'cheekPuff', mirror: 46, cost: 2, faps: [[6, -20], [7, -20], [39, 180], [40, 180], [53, -20], [54, -20]] },
  { name: 'cheekSquintLeft', mirror: 48, cost: 2, faps: [[21, 130], [41, 150]] },
  { name: 'cheekSquintRight', mirror: 47, cost: 2, faps: [[22, 130], [42, 150]] },
  { name: 'noseSneerLeft', mirror: 50, cost: 0.4, faps: [[4, -170], [5, 20], [8, -320], [9, -65], [10, 68], [11, 14], [12, 237], [18, 14], [21, 113], [31, -75], [33, -48], [35, -11], [37, 9], [41, 145], [51, -186], [52, 15], [53, -19], [55, -376], [56, -77], [57, 55], [58, 12], [59, 302], [61, 20], [63, 38]] },
  { name: 'noseSneerRight', mirror: 49, cost: 0.4, faps: [[4, -170], [5, 20], [8, -65], [9, -320], [10, 14], [11, 68], [13, 237], [18, 14], [22, 113], [32, -75], [34, -48], [36, -11], [38, 9], [42, 145], [51, -186], [52, 15], [54, -19], [55, -77], [56, -376], [57, 12], [58, 55], [60, 302], [62, 20], [63, 38]] },
  { name: 'tongueOut', mirror: 51, cost: 0, faps: [[44, -40], [45, 400]] },
];
