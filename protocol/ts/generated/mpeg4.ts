// Generated from core/tables/data by semblante-codegen-tables; change the data, not this.

export type FapKind = "high_level" | "translation" | "rotation" | "scale";
export type FapUnit = "IRISD" | "ES" | "ENS" | "MNS" | "MW" | "AU";
export type Side = "center" | "left" | "right";

export interface FapGroup {
  readonly number: number;
  readonly name: string;
  readonly first: number;
  readonly last: number;
}

export interface Fap {
  /** 1..68 */
  readonly number: number;
  readonly name: string;
  readonly description: string;
  readonly group: number;
  readonly kind: FapKind;
  /** null for FAPs 1 and 2 */
  readonly unit: FapUnit | null;
  readonly bidirectional: boolean;
  /** 0 x, 1 y, 2 z; null where the FAP moves or turns nothing along one axis */
  readonly axis: 0 | 1 | 2 | null;
  /** displacement (or angle) = sign * value * unit along (or about) the axis */
  readonly sign: -1 | 0 | 1;
  readonly featurePoints: readonly string[];
  /** To mirror a frame: new[mirror] = mirrorSign * old[number]; 0 for FAPs 1 and 2. */
  readonly mirror: number;
  readonly mirrorSign: -1 | 0 | 1;
  readonly quantizerStep: number;
  /** Range the wire carries, FAP units. */
  readonly min: number;
  readonly max: number;
  /** What a face does, FAP units: the range of a slider. */
  readonly usualMin: number;
  readonly usualMax: number;
}

export interface FeaturePoint {
  readonly id: string;
  readonly side: Side;
  /** id of the point on the other side; its own in the middle */
  readonly mirror: string;
}

/** Coordinate `axis` (0 x, 1 y, 2 z) of `to` minus that of `from`, on the neutral face. */
export interface FapuMeasure {
  readonly from: string;
  readonly to: string;
  readonly axis: 0 | 1;
}

export interface Fapu {
  readonly name: FapUnit;
  readonly meaning: string;
  /** The unit is 1024th of their mean; two: left and right eye; none: an angle. */
  readonly measures: readonly FapuMeasure[];
}

export interface Viseme {
  readonly name: string;
  /** IPA */
  readonly phonemes: readonly string[];
  readonly examples: readonly string[];
}

export interface Expression {
  readonly name: string;
  readonly description: string;
}

export const fapCount = 68;
export const featurePointCount = 84;

/** `quantizerStep` of FAPs 1 to 68, for pages that need nothing else of them. */
export const quantizerSteps: readonly number[] = [1,1,4,2,2,2,2,2,2,2,2,2,2,1,1,1,1,1,1,1,1,1,128,128,128,128,1,1,1,1,2,2,2,2,2,2,1,1,2,2,2,2,1,1,1,1,512,170,170,170,2,2,2,2,2,2,2,2,2,2,1,1,1,1,1,1,1,1];

export const fapGroups: readonly FapGroup[] = [
  {"number":1,"name":"visemes and expressions","first":1,"last":2},
  {"number":2,"name":"jaw, chin and inner lip contour","first":3,"last":18},
  {"number":3,"name":"eyeballs, pupils, eyelids","first":19,"last":30},
  {"number":4,"name":"eyebrows","first":31,"last":38},
  {"number":5,"name":"cheeks","first":39,"last":42},
  {"number":6,"name":"tongue","first":43,"last":47},
  {"number":7,"name":"head rotation","first":48,"last":50},
  {"number":8,"name":"outer lip contour","first":51,"last":60},
  {"number":9,"name":"nose","first":61,"last":64},
  {"number":10,"name":"ears","first":65,"last":68},
];

/** faps[n - 1] is FAP n. */
export const faps: readonly Fap[] = [
  {"number":1,"name":"viseme","description":"High-level: blend of two entries of the viseme table","group":1,"kind":"high_level","unit":null,"bidirectional":false,"axis":null,"sign":0,"featurePoints":[],"mirror":0,"mirrorSign":0,"quantizerStep":1,"min":0,"max":0,"usualMin":0,"usualMax":0},
  {"number":2,"name":"expression","description":"High-level: blend of two entries of the expression table","group":1,"kind":"high_level","unit":null,"bidirectional":false,"axis":null,"sign":0,"featurePoints":[],"mirror":0,"mirrorSign":0,"quantizerStep":1,"min":0,"max":0,"usualMin":0,"usualMax":0},
  {"number":3,"name":"open_jaw","description":"Lower jaw goes down; by definition this does not by itself part the lips","group":2,"kind":"translation","unit":"MNS","bidirectional":false,"axis":1,"sign":-1,"featurePoints":["2.1"],"mirror":3,"mirrorSign":1,"quantizerStep":4,"min":0,"max":4320,"usualMin":0,"usualMax":700},
  {"number":4,"name":"lower_t_midlip","description":"Middle of the inner contour of the upper (top) lip goes down","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["2.2"],"mirror":4,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":5,"name":"raise_b_midlip","description":"Middle of the inner contour of the lower (bottom) lip goes up","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.3"],"mirror":5,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":6,"name":"stretch_l_cornerlip","description":"Left corner of the inner lip contour goes outwards (to the left)","group":2,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":1,"featurePoints":["2.4"],"mirror":7,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-160,"usualMax":160},
  {"number":7,"name":"stretch_r_cornerlip","description":"Right corner of the inner lip contour goes outwards (to the right)","group":2,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["2.5"],"mirror":6,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-160,"usualMax":160},
  {"number":8,"name":"lower_t_lip_lm","description":"Upper lip, inner contour, half way between middle and left corner, goes down","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["2.6"],"mirror":9,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":9,"name":"lower_t_lip_rm","description":"Upper lip, inner contour, half way between middle and right corner, goes down","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["2.7"],"mirror":8,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":10,"name":"raise_b_lip_lm","description":"Lower lip, inner contour, half way between middle and left corner, goes up","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.8"],"mirror":11,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":11,"name":"raise_b_lip_rm","description":"Lower lip, inner contour, half way between middle and right corner, goes up","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.9"],"mirror":10,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":12,"name":"raise_l_cornerlip","description":"Left corner of the inner lip contour goes up","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.4"],"mirror":13,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-300,"usualMax":300},
  {"number":13,"name":"raise_r_cornerlip","description":"Right corner of the inner lip contour goes up","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.5"],"mirror":12,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-300,"usualMax":300},
  {"number":14,"name":"thrust_jaw","description":"Lower jaw goes forward","group":2,"kind":"translation","unit":"MNS","bidirectional":false,"axis":2,"sign":1,"featurePoints":["2.1"],"mirror":14,"mirrorSign":1,"quantizerStep":1,"min":0,"max":600,"usualMin":0,"usualMax":200},
  {"number":15,"name":"shift_jaw","description":"Lower jaw goes sideways","group":2,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["2.1"],"mirror":15,"mirrorSign":-1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-150,"usualMax":150},
  {"number":16,"name":"push_b_lip","description":"Middle of the lower lip goes forward","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":2,"sign":1,"featurePoints":["2.3"],"mirror":16,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-250,"usualMax":250},
  {"number":17,"name":"push_t_lip","description":"Middle of the upper lip goes forward","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":2,"sign":1,"featurePoints":["2.2"],"mirror":17,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-250,"usualMax":250},
  {"number":18,"name":"depress_chin","description":"Chin boss is pushed up and compressed (as in a pout); positive is UP in spite of the name","group":2,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["2.10"],"mirror":18,"mirrorSign":1,"quantizerStep":1,"min":-420,"max":420,"usualMin":-200,"usualMax":200},
  {"number":19,"name":"close_t_l_eyelid","description":"Upper (top) lid of the left eye goes down","group":3,"kind":"translation","unit":"IRISD","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["3.1"],"mirror":20,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-300,"usualMax":1024},
  {"number":20,"name":"close_t_r_eyelid","description":"Upper (top) lid of the right eye goes down","group":3,"kind":"translation","unit":"IRISD","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["3.2"],"mirror":19,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-300,"usualMax":1024},
  {"number":21,"name":"close_b_l_eyelid","description":"Lower (bottom) lid of the left eye goes up","group":3,"kind":"translation","unit":"IRISD","bidirectional":true,"axis":1,"sign":1,"featurePoints":["3.3"],"mirror":22,"mirrorSign":1,"quantizerStep":1,"min":-600,"max":600,"usualMin":-250,"usualMax":400},
  {"number":22,"name":"close_b_r_eyelid","description":"Lower (bottom) lid of the right eye goes up","group":3,"kind":"translation","unit":"IRISD","bidirectional":true,"axis":1,"sign":1,"featurePoints":["3.4"],"mirror":21,"mirrorSign":1,"quantizerStep":1,"min":-600,"max":600,"usualMin":-250,"usualMax":400},
  {"number":23,"name":"yaw_l_eyeball","description":"Left eyeball turns about the vertical; positive looks to the face's left","group":3,"kind":"rotation","unit":"AU","bidirectional":true,"axis":1,"sign":1,"featurePoints":["3.5"],"mirror":24,"mirrorSign":-1,"quantizerStep":128,"min":-153600,"max":153600,"usualMin":-50000,"usualMax":50000},
  {"number":24,"name":"yaw_r_eyeball","description":"Right eyeball turns about the vertical; positive looks to the face's left","group":3,"kind":"rotation","unit":"AU","bidirectional":true,"axis":1,"sign":1,"featurePoints":["3.6"],"mirror":23,"mirrorSign":-1,"quantizerStep":128,"min":-153600,"max":153600,"usualMin":-50000,"usualMax":50000},
  {"number":25,"name":"pitch_l_eyeball","description":"Left eyeball turns about the left-right axis; positive looks down","group":3,"kind":"rotation","unit":"AU","bidirectional":true,"axis":0,"sign":1,"featurePoints":["3.5"],"mirror":26,"mirrorSign":1,"quantizerStep":128,"min":-115200,"max":115200,"usualMin":-40000,"usualMax":40000},
  {"number":26,"name":"pitch_r_eyeball","description":"Right eyeball turns about the left-right axis; positive looks down","group":3,"kind":"rotation","unit":"AU","bidirectional":true,"axis":0,"sign":1,"featurePoints":["3.6"],"mirror":25,"mirrorSign":1,"quantizerStep":128,"min":-115200,"max":115200,"usualMin":-40000,"usualMax":40000},
  {"number":27,"name":"thrust_l_eyeball","description":"Left eyeball goes forward","group":3,"kind":"translation","unit":"ES","bidirectional":true,"axis":2,"sign":1,"featurePoints":["3.5"],"mirror":28,"mirrorSign":1,"quantizerStep":1,"min":-600,"max":600,"usualMin":-60,"usualMax":60},
  {"number":28,"name":"thrust_r_eyeball","description":"Right eyeball goes forward","group":3,"kind":"translation","unit":"ES","bidirectional":true,"axis":2,"sign":1,"featurePoints":["3.6"],"mirror":27,"mirrorSign":1,"quantizerStep":1,"min":-600,"max":600,"usualMin":-60,"usualMax":60},
  {"number":29,"name":"dilate_l_pupil","description":"Pupil of the left eye grows","group":3,"kind":"scale","unit":"IRISD","bidirectional":true,"axis":null,"sign":0,"featurePoints":["3.5"],"mirror":30,"mirrorSign":1,"quantizerStep":1,"min":-420,"max":420,"usualMin":-300,"usualMax":300},
  {"number":30,"name":"dilate_r_pupil","description":"Pupil of the right eye grows","group":3,"kind":"scale","unit":"IRISD","bidirectional":true,"axis":null,"sign":0,"featurePoints":["3.6"],"mirror":29,"mirrorSign":1,"quantizerStep":1,"min":-420,"max":420,"usualMin":-300,"usualMax":300},
  {"number":31,"name":"raise_l_i_eyebrow","description":"Inner end of the left eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.1"],"mirror":32,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":32,"name":"raise_r_i_eyebrow","description":"Inner end of the right eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.2"],"mirror":31,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":33,"name":"raise_l_m_eyebrow","description":"Middle of the left eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.3"],"mirror":34,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":34,"name":"raise_r_m_eyebrow","description":"Middle of the right eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.4"],"mirror":33,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":35,"name":"raise_l_o_eyebrow","description":"Outer end of the left eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.5"],"mirror":36,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":36,"name":"raise_r_o_eyebrow","description":"Outer end of the right eyebrow goes up","group":4,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["4.6"],"mirror":35,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-200,"usualMax":350},
  {"number":37,"name":"squeeze_l_eyebrow","description":"Inner end of the left eyebrow goes towards the midline (to the right)","group":4,"kind":"translation","unit":"ES","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["4.1"],"mirror":38,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-60,"usualMax":160},
  {"number":38,"name":"squeeze_r_eyebrow","description":"Inner end of the right eyebrow goes towards the midline (to the left)","group":4,"kind":"translation","unit":"ES","bidirectional":true,"axis":0,"sign":1,"featurePoints":["4.2"],"mirror":37,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-60,"usualMax":160},
  {"number":39,"name":"puff_l_cheek","description":"Centre of the left cheek goes outwards (to the left)","group":5,"kind":"translation","unit":"ES","bidirectional":true,"axis":0,"sign":1,"featurePoints":["5.1"],"mirror":40,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-80,"usualMax":200},
  {"number":40,"name":"puff_r_cheek","description":"Centre of the right cheek goes outwards (to the right)","group":5,"kind":"translation","unit":"ES","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["5.2"],"mirror":39,"mirrorSign":1,"quantizerStep":2,"min":-1800,"max":1800,"usualMin":-80,"usualMax":200},
  {"number":41,"name":"lift_l_cheek","description":"Left cheek bone region goes up","group":5,"kind":"translation","unit":"ENS","bidirectional":false,"axis":1,"sign":1,"featurePoints":["5.3"],"mirror":42,"mirrorSign":1,"quantizerStep":2,"min":0,"max":1800,"usualMin":0,"usualMax":300},
  {"number":42,"name":"lift_r_cheek","description":"Right cheek bone region goes up","group":5,"kind":"translation","unit":"ENS","bidirectional":false,"axis":1,"sign":1,"featurePoints":["5.4"],"mirror":41,"mirrorSign":1,"quantizerStep":2,"min":0,"max":1800,"usualMin":0,"usualMax":300},
  {"number":43,"name":"shift_tongue_tip","description":"Tongue tip goes sideways","group":6,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["6.1"],"mirror":43,"mirrorSign":-1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-250,"usualMax":250},
  {"number":44,"name":"raise_tongue_tip","description":"Tongue tip goes up","group":6,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["6.1"],"mirror":44,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-300,"usualMax":300},
  {"number":45,"name":"thrust_tongue_tip","description":"Tongue tip goes forward","group":6,"kind":"translation","unit":"MW","bidirectional":true,"axis":2,"sign":1,"featurePoints":["6.1"],"mirror":45,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-100,"usualMax":400},
  {"number":46,"name":"raise_tongue","description":"Body of the tongue goes up","group":6,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["6.2"],"mirror":46,"mirrorSign":1,"quantizerStep":1,"min":-1080,"max":1080,"usualMin":-300,"usualMax":300},
  {"number":47,"name":"tongue_roll","description":"Tongue rolls into a U: both borders turn upwards about the length of the tongue","group":6,"kind":"rotation","unit":"AU","bidirectional":false,"axis":null,"sign":0,"featurePoints":["6.3","6.4"],"mirror":47,"mirrorSign":1,"quantizerStep":512,"min":0,"max":552960,"usualMin":0,"usualMax":90000},
  {"number":48,"name":"head_pitch","description":"Head nods about the left-right axis through 7.1; positive looks down","group":7,"kind":"rotation","unit":"AU","bidirectional":true,"axis":0,"sign":1,"featurePoints":["7.1"],"mirror":48,"mirrorSign":1,"quantizerStep":170,"min":-316200,"max":316200,"usualMin":-60000,"usualMax":60000},
  {"number":49,"name":"head_yaw","description":"Head turns about the vertical through 7.1; positive looks to the face's left","group":7,"kind":"rotation","unit":"AU","bidirectional":true,"axis":1,"sign":1,"featurePoints":["7.1"],"mirror":49,"mirrorSign":-1,"quantizerStep":170,"min":-316200,"max":316200,"usualMin":-90000,"usualMax":90000},
  {"number":50,"name":"head_roll","description":"Head tilts about the front-back axis through 7.1; positive: top of the head goes to the face's right","group":7,"kind":"rotation","unit":"AU","bidirectional":true,"axis":2,"sign":1,"featurePoints":["7.1"],"mirror":50,"mirrorSign":-1,"quantizerStep":170,"min":-316200,"max":316200,"usualMin":-60000,"usualMax":60000},
  {"number":51,"name":"lower_t_midlip_o","description":"Middle of the outer contour of the upper lip goes down","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["8.1"],"mirror":51,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":52,"name":"raise_b_midlip_o","description":"Middle of the outer contour of the lower lip goes up","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["8.2"],"mirror":52,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":53,"name":"stretch_l_cornerlip_o","description":"Left corner of the outer lip contour goes outwards (to the left)","group":8,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":1,"featurePoints":["8.3"],"mirror":54,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-160,"usualMax":160},
  {"number":54,"name":"stretch_r_cornerlip_o","description":"Right corner of the outer lip contour goes outwards (to the right)","group":8,"kind":"translation","unit":"MW","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["8.4"],"mirror":53,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-160,"usualMax":160},
  {"number":55,"name":"lower_t_lip_lm_o","description":"Upper lip, outer contour, half way between middle and left corner, goes down","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["8.5"],"mirror":56,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":56,"name":"lower_t_lip_rm_o","description":"Upper lip, outer contour, half way between middle and right corner, goes down","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":-1,"featurePoints":["8.6"],"mirror":55,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-250,"usualMax":250},
  {"number":57,"name":"raise_b_lip_lm_o","description":"Lower lip, outer contour, half way between middle and left corner, goes up","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["8.7"],"mirror":58,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":58,"name":"raise_b_lip_rm_o","description":"Lower lip, outer contour, half way between middle and right corner, goes up","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["8.8"],"mirror":57,"mirrorSign":1,"quantizerStep":2,"min":-3720,"max":3720,"usualMin":-900,"usualMax":300},
  {"number":59,"name":"raise_l_cornerlip_o","description":"Left corner of the outer lip contour goes up","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["8.3"],"mirror":60,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-300,"usualMax":300},
  {"number":60,"name":"raise_r_cornerlip_o","description":"Right corner of the outer lip contour goes up","group":8,"kind":"translation","unit":"MNS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["8.4"],"mirror":59,"mirrorSign":1,"quantizerStep":2,"min":-1200,"max":1200,"usualMin":-300,"usualMax":300},
  {"number":61,"name":"stretch_l_nose","description":"Left side of the nose goes outwards (to the left)","group":9,"kind":"translation","unit":"ENS","bidirectional":true,"axis":0,"sign":1,"featurePoints":["9.1"],"mirror":62,"mirrorSign":1,"quantizerStep":1,"min":-540,"max":540,"usualMin":-60,"usualMax":120},
  {"number":62,"name":"stretch_r_nose","description":"Right side of the nose goes outwards (to the right)","group":9,"kind":"translation","unit":"ENS","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["9.2"],"mirror":61,"mirrorSign":1,"quantizerStep":1,"min":-540,"max":540,"usualMin":-60,"usualMax":120},
  {"number":63,"name":"raise_nose","description":"Nose tip goes up","group":9,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["9.3"],"mirror":63,"mirrorSign":1,"quantizerStep":1,"min":-680,"max":680,"usualMin":-100,"usualMax":120},
  {"number":64,"name":"bend_nose","description":"Nose tip goes sideways","group":9,"kind":"translation","unit":"ENS","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["9.3"],"mirror":64,"mirrorSign":-1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-120,"usualMax":120},
  {"number":65,"name":"raise_l_ear","description":"Left ear goes up","group":10,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["10.1"],"mirror":66,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-200,"usualMax":200},
  {"number":66,"name":"raise_r_ear","description":"Right ear goes up","group":10,"kind":"translation","unit":"ENS","bidirectional":true,"axis":1,"sign":1,"featurePoints":["10.2"],"mirror":65,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-200,"usualMax":200},
  {"number":67,"name":"pull_l_ear","description":"Left ear goes outwards (to the left)","group":10,"kind":"translation","unit":"ENS","bidirectional":true,"axis":0,"sign":1,"featurePoints":["10.3"],"mirror":68,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-200,"usualMax":200},
  {"number":68,"name":"pull_r_ear","description":"Right ear goes outwards (to the right)","group":10,"kind":"translation","unit":"ENS","bidirectional":true,"axis":0,"sign":-1,"featurePoints":["10.4"],"mirror":67,"mirrorSign":1,"quantizerStep":1,"min":-900,"max":900,"usualMin":-200,"usualMax":200},
];

/** In the order of the standard: the index is the dense feature point index of the formats. */
export const featurePoints: readonly FeaturePoint[] = [
  {"id":"2.1","side":"center","mirror":"2.1"},
  {"id":"2.2","side":"center","mirror":"2.2"},
  {"id":"2.3","side":"center","mirror":"2.3"},
  {"id":"2.4","side":"left","mirror":"2.5"},
  {"id":"2.5","side":"right","mirror":"2.4"},
  {"id":"2.6","side":"left","mirror":"2.7"},
  {"id":"2.7","side":"right","mirror":"2.6"},
  {"id":"2.8","side":"left","mirror":"2.9"},
  {"id":"2.9","side":"right","mirror":"2.8"},
  {"id":"2.10","side":"center","mirror":"2.10"},
  {"id":"2.11","side":"left","mirror":"2.12"},
  {"id":"2.12","side":"right","mirror":"2.11"},
  {"id":"2.13","side":"left","mirror":"2.14"},
  {"id":"2.14","side":"right","mirror":"2.13"},
  {"id":"3.1","side":"left","mirror":"3.2"},
  {"id":"3.2","side":"right","mirror":"3.1"},
  {"id":"3.3","side":"left","mirror":"3.4"},
  {"id":"3.4","side":"right","mirror":"3.3"},
  {"id":"3.5","side":"left","mirror":"3.6"},
  {"id":"3.6","side":"right","mirror":"3.5"},
  {"id":"3.7","side":"left","mirror":"3.12"},
  {"id":"3.8","side":"right","mirror":"3.11"},
  {"id":"3.9","side":"left","mirror":"3.10"},
  {"id":"3.10","side":"right","mirror":"3.9"},
  {"id":"3.11","side":"left","mirror":"3.8"},
  {"id":"3.12","side":"right","mirror":"3.7"},
  {"id":"3.13","side":"left","mirror":"3.14"},
  {"id":"3.14","side":"right","mirror":"3.13"},
  {"id":"4.1","side":"left","mirror":"4.2"},
  {"id":"4.2","side":"right","mirror":"4.1"},
  {"id":"4.3","side":"left","mirror":"4.4"},
  {"id":"4.4","side":"right","mirror":"4.3"},
  {"id":"4.5","side":"left","mirror":"4.6"},
  {"id":"4.6","side":"right","mirror":"4.5"},
  {"id":"5.1","side":"left","mirror":"5.2"},
  {"id":"5.2","side":"right","mirror":"5.1"},
  {"id":"5.3","side":"left","mirror":"5.4"},
  {"id":"5.4","side":"right","mirror":"5.3"},
  {"id":"6.1","side":"center","mirror":"6.1"},
  {"id":"6.2","side":"center","mirror":"6.2"},
  {"id":"6.3","side":"left","mirror":"6.4"},
  {"id":"6.4","side":"right","mirror":"6.3"},
  {"id":"7.1","side":"center","mirror":"7.1"},
  {"id":"8.1","side":"center","mirror":"8.1"},
  {"id":"8.2","side":"center","mirror":"8.2"},
  {"id":"8.3","side":"left","mirror":"8.4"},
  {"id":"8.4","side":"right","mirror":"8.3"},
  {"id":"8.5","side":"left","mirror":"8.6"},
  {"id":"8.6","side":"right","mirror":"8.5"},
  {"id":"8.7","side":"left","mirror":"8.8"},
  {"id":"8.8","side":"right","mirror":"8.7"},
  {"id":"8.9","side":"right","mirror":"8.10"},
  {"id":"8.10","side":"left","mirror":"8.9"},
  {"id":"9.1","side":"left","mirror":"9.2"},
  {"id":"9.2","side":"right","mirror":"9.1"},
  {"id":"9.3","side":"center","mirror":"9.3"},
  {"id":"9.4","side":"right","mirror":"9.5"},
  {"id":"9.5","side":"left","mirror":"9.4"},
  {"id":"9.6","side":"right","mirror":"9.7"},
  {"id":"9.7","side":"left","mirror":"9.6"},
  {"id":"9.8","side":"center","mirror":"9.8"},
  {"id":"9.9","side":"center","mirror":"9.9"},
  {"id":"9.10","side":"center","mirror":"9.10"},
  {"id":"9.11","side":"center","mirror":"9.11"},
  {"id":"9.12","side":"center","mirror":"9.12"},
  {"id":"9.13","side":"left","mirror":"9.14"},
  {"id":"9.14","side":"right","mirror":"9.13"},
  {"id":"9.15","side":"center","mirror":"9.15"},
  {"id":"10.1","side":"left","mirror":"10.2"},
  {"id":"10.2","side":"right","mirror":"10.1"},
  {"id":"10.3","side":"left","mirror":"10.4"},
  {"id":"10.4","side":"right","mirror":"10.3"},
  {"id":"10.5","side":"left","mirror":"10.6"},
  {"id":"10.6","side":"right","mirror":"10.5"},
  {"id":"10.7","side":"left","mirror":"10.8"},
  {"id":"10.8","side":"right","mirror":"10.7"},
  {"id":"10.9","side":"left","mirror":"10.10"},
  {"id":"10.10","side":"right","mirror":"10.9"},
  {"id":"11.1","side":"center","mirror":"11.1"},
  {"id":"11.2","side":"right","mirror":"11.3"},
  {"id":"11.3","side":"left","mirror":"11.2"},
  {"id":"11.4","side":"center","mirror":"11.4"},
  {"id":"11.5","side":"center","mirror":"11.5"},
  {"id":"11.6","side":"center","mirror":"11.6"},
];

/** Of featurePoints, at the same index: for people who place them. */
export const featurePointNames: readonly string[] = [
  "bottom of the chin",
  "middle of the inner contour of the upper lip",
  "middle of the inner contour of the lower lip",
  "left corner of the inner lip contour",
  "right corner of the inner lip contour",
  "inner contour of the upper lip, half way between 2.2 and 2.4",
  "inner contour of the upper lip, half way between 2.2 and 2.5",
  "inner contour of the lower lip, half way between 2.3 and 2.4",
  "inner contour of the lower lip, half way between 2.3 and 2.5",
  "chin boss (front of the chin)",
  "left corner of the chin",
  "right corner of the chin",
  "left corner of the jaw bone",
  "right corner of the jaw bone",
  "left eye: middle of the edge of the upper lid (inner lid contour)",
  "right eye: middle of the edge of the upper lid (inner lid contour)",
  "left eye: middle of the edge of the lower lid (inner lid contour)",
  "right eye: middle of the edge of the lower lid (inner lid contour)",
  "centre of the pupil of the left eye",
  "centre of the pupil of the right eye",
  "left (outer) corner of the left eye",
  "left (inner) corner of the right eye",
  "left eye: middle of the outer contour (fold) of the lower lid",
  "right eye: middle of the outer contour (fold) of the lower lid",
  "right (inner) corner of the left eye",
  "right (outer) corner of the right eye",
  "left eye: middle of the outer contour (fold) of the upper lid",
  "right eye: middle of the outer contour (fold) of the upper lid",
  "right (inner) end of the left eyebrow",
  "left (inner) end of the right eyebrow",
  "highest point of the left eyebrow",
  "highest point of the right eyebrow",
  "left (outer) end of the left eyebrow",
  "right (outer) end of the right eyebrow",
  "centre of the left cheek",
  "centre of the right cheek",
  "left cheek bone",
  "right cheek bone",
  "tip of the tongue",
  "centre of the body of the tongue",
  "left border of the tongue",
  "right border of the tongue",
  "top of the spine: centre of the head rotations",
  "middle of the outer contour of the upper lip",
  "middle of the outer contour of the lower lip",
  "left corner of the outer lip contour",
  "right corner of the outer lip contour",
  "outer contour of the upper lip, half way between 8.1 and 8.3",
  "outer contour of the upper lip, half way between 8.1 and 8.4",
  "outer contour of the lower lip, half way between 8.2 and 8.3",
  "outer contour of the lower lip, half way between 8.2 and 8.4",
  "right peak of the cupid's bow of the upper lip",
  "left peak of the cupid's bow of the upper lip",
  "left border of the nostrils (wing of the nose)",
  "right border of the nostrils (wing of the nose)",
  "tip of the nose",
  "lower right edge of the nose",
  "lower left edge of the nose",
  "right upper edge of the nose bone",
  "left upper edge of the nose bone",
  "top of the upper teeth",
  "bottom of the lower teeth",
  "bottom (biting edge) of the upper teeth",
  "top (biting edge) of the lower teeth",
  "middle of the lower edge of the nose bone (or the bump of the nose)",
  "left lower edge of the nose bone",
  "right lower edge of the nose bone",
  "middle of the lower edge of the nose (where the nose meets the upper lip)",
  "top of the left ear",
  "top of the right ear",
  "back of the left ear",
  "back of the right ear",
  "bottom of the left ear lobe",
  "bottom of the right ear lobe",
  "lower contact of the left ear lobe with the face",
  "lower contact of the right ear lobe with the face",
  "upper contact of the left ear with the face",
  "upper contact of the right ear with the face",
  "middle of the border between hair and forehead",
  "right part of the border between hair and forehead",
  "left part of the border between hair and forehead",
  "top of the skull",
  "top of the hair above 11.4 (gives the thickness of the hair)",
  "back of the skull",
];

/** The points to mark first, in this order: the others are proposed from them. */
export const quickSet: readonly string[] = [
  "9.3",
  "9.15",
  "8.1",
  "2.2",
  "2.3",
  "8.2",
  "2.1",
  "11.4",
  "3.11",
  "3.7",
  "3.1",
  "3.3",
  "3.12",
  "4.1",
  "4.5",
  "9.1",
  "8.3",
  "2.13",
  "10.1",
  "10.5",
];

export const fapus: readonly Fapu[] = [
  {"name":"IRISD","meaning":"iris diameter (equal, by the definition of the neutral face, to the distance between upper and lower lid)","measures":[{"from":"3.3","to":"3.1","axis":1},{"from":"3.4","to":"3.2","axis":1}]},
  {"name":"ES","meaning":"distance between the centres of the eyes (pupils)","measures":[{"from":"3.6","to":"3.5","axis":0}]},
  {"name":"ENS","meaning":"distance from the line between the eyes to the base of the nose","measures":[{"from":"9.15","to":"3.5","axis":1}]},
  {"name":"MNS","meaning":"distance from the base of the nose to the mouth line","measures":[{"from":"2.2","to":"9.15","axis":1}]},
  {"name":"MW","meaning":"mouth width","measures":[{"from":"8.4","to":"8.3","axis":0}]},
  {"name":"AU","meaning":"angle unit","measures":[]},
];

/** By the number that FAP 1 selects. */
export const visemes: readonly Viseme[] = [
  {"name":"sil","phonemes":[],"examples":[]},
  {"name":"p_b_m","phonemes":["p","b","m"],"examples":["put","bed","mill"]},
  {"name":"f_v","phonemes":["f","v"],"examples":["far","voice"]},
  {"name":"th","phonemes":["θ","ð"],"examples":["think","that"]},
  {"name":"t_d","phonemes":["t","d"],"examples":["tip","doll"]},
  {"name":"k_g","phonemes":["k","g"],"examples":["call","gas"]},
  {"name":"ch_j_sh","phonemes":["tʃ","dʒ","ʃ"],"examples":["chair","join","she"]},
  {"name":"s_z","phonemes":["s","z"],"examples":["sir","zeal"]},
  {"name":"n_l","phonemes":["n","l"],"examples":["lot","not"]},
  {"name":"r","phonemes":["r"],"examples":["red"]},
  {"name":"a","phonemes":["ɑː"],"examples":["car"]},
  {"name":"e","phonemes":["e"],"examples":["bed"]},
  {"name":"i","phonemes":["ɪ"],"examples":["tip"]},
  {"name":"o","phonemes":["ɒ"],"examples":["top"]},
  {"name":"u","phonemes":["ʊ"],"examples":["book"]},
];

/** By the number that FAP 2 selects; 0 is none. */
export const expressions: readonly Expression[] = [
  {"name":"none","description":"no expression"},
  {"name":"joy","description":"brows relaxed; mouth open, its corners drawn back towards the ears"},
  {"name":"sadness","description":"inner ends of the brows bent upwards; eyes slightly closed; mouth relaxed"},
  {"name":"anger","description":"inner ends of the brows pulled down and together; eyes wide open; lips pressed together, or parted so that the teeth show"},
  {"name":"fear","description":"brows raised and pulled together, their inner ends bent upwards; eyes tense and alert"},
  {"name":"disgust","description":"brows and lids relaxed; upper lip raised and curled, often on one side more than the other"},
  {"name":"surprise","description":"brows raised; upper lids wide open, lower lids relaxed; jaw opened"},
];
