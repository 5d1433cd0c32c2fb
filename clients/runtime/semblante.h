/* libsemblante: everything that a client does between bytes and vertices. Face packages, streams, playing, publishing,
 * performances, takes, bridges, listeners and speakers.
 *
 *   semblante_package package = {0};
 *   package.size = sizeof(package);
 *   package.positions = positions;  package.vertex_count = n;   // decoded mesh.drc, in decoded order; or mesh_drc
 *   package.weights = weights;      package.weights_size = weights_size;  // bytes of `weights`
 *   package.rig_json = rig;         package.rig_json_size = rig_size;     // bytes of `rig.json`
 *   semblante_head* head;
 *   semblante_error error;
 *   if (semblante_head_create(&package, NULL, &head, &error) != SEMBLANTE_OK) return puts(error.message);
 *   semblante_frame frame = {0};
 *   frame.fap[3] = 300;                                         // open the jaw
 *   semblante_head_set_frame(head, &frame);
 *   semblante_head_positions(head, out, 3 * n);                 // draw these
 *   semblante_head_destroy(head);
 *
 * Rules for the whole header:
 * - The library opens no socket or file, starts no thread, reads no clock, logs nothing, uses no locale, calls nothing
 *   of the caller, has no mutable global state, and no exception leaves it. Bytes and times go in; vertices, poses,
 *   bytes to send and events come out.
 * - Times are milliseconds. `now` is the caller's steady clock with any origin. It must not decrease from call to call
 *   of one object, and all objects that follow each other must use the same clock. Media time is the clock of a
 *   stream. A time that is not finite or is beyond +-9e15 (285,000 years) is none: such a `now` makes the call do
 *   nothing, any other is INVALID_ARGUMENT.
 * - Memory is allocated by the functions named _create and _read, and when a documented limit grows (the longest
 *   message, the frames that a player holds). From then on a frame allocates nothing. When memory is exhausted a
 *   function returns OUT_OF_MEMORY, or does nothing if it has no result.
 * - Threads: functions that take only const objects may run at the same time on the same objects; the others need
 *   exclusive access to each object that is not const. A stream and the players that follow it count as one object.
 *   Different objects are independent.
 * - Lifetime: what a function returns by pointer belongs to the object. It is valid until the object is destroyed, or
 *   as the function says. Every _destroy accepts null.
 * - Structs of options and results begin with `size`, which the caller sets to sizeof(the struct) as compiled. Members
 *   are only appended; the library reads and writes no more than `size` bytes, and takes zero for what is missing. They
 *   are valid when otherwise zeroed. A `size` too small for the member itself is INVALID_ARGUMENT.
 * - Bytes from outside (packages, messages, documents, files) are not trusted: all are checked, with bounds on time and
 *   memory.
 * - Frames and poses are the kernel's own (semblante_kernel.h); its functions are exported as well.
 *
 * The numbers in a frame. Section 1.5 of protocol/SPEC.md, which a server has at /v1/protocol/SPEC.md, lists every FAP
 * with its unit, axis and range. FAPs 19 and 20 at 1024 close the upper lids, as a blink does.
 *   viseme: 0 sil, 1 p_b_m, 2 f_v, 3 th, 4 t_d, 5 k_g, 6 ch_j_sh, 7 s_z, 8 n_l, 9 r, 10 a, 11 e, 12 i, 13 o, 14 u
 *   expression: 0 none, 1 joy, 2 sadness, 3 anger, 4 fear, 5 disgust, 6 surprise
 */
#ifndef SEMBLANTE_H
#define SEMBLANTE_H

#include <stddef.h>
#include <stdint.h>

#include "core/kernel/semblante_ease.h"
#include "core/kernel/semblante_kernel.h"
#include "core/kernel/semblante_normals.h"
#include "core/kernel/semblante_prepared_face.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SEMBLANTE_SDK_VERSION 0x000200u /* 0.2.0: 8 bits each */

/* ---- results and errors --------------------------------------------------------------------------------------- */

/* Result codes. Values never change; new ones are added at the end. */
typedef enum semblante_result {
  SEMBLANTE_OK = 0,
  SEMBLANTE_INVALID_ARGUMENT = 1, /* a null that is not allowed, a number that is not finite or out of range */
  SEMBLANTE_MALFORMED = 2,        /* the bytes do not follow their format, or end early */
  SEMBLANTE_UNSUPPORTED = 3,      /* a version, or a part of this header, that this build does not have */
  SEMBLANTE_MISMATCH = 4,  /* mesh, weights and rig do not belong to one package; frames do not follow each other */
  SEMBLANTE_TOO_LARGE = 5, /* over a documented limit */
  SEMBLANTE_BUFFER_TOO_SMALL = 6, /* nothing was written */
  SEMBLANTE_OUT_OF_MEMORY = 7,
  SEMBLANTE_INTERNAL = 8,
  SEMBLANTE_UNAVAILABLE = 9 /* not now: there is no open connection, no data yet, or too much waits to be sent */
} semblante_result;

/* Text for display, zero-terminated UTF-8, truncated to fit. `where` names the member or byte at fault; may be empty.
 * Functions that take one accept null. They write it only when they fail. */
typedef struct semblante_error {
  char where[96];
  char message[256];
} semblante_error;

/* Version of the loaded library, to compare with SEMBLANTE_SDK_VERSION. */
uint32_t semblante_sdk_version(void);
/* "ok", "malformed", ...: a static string for logs. */
const char* semblante_result_name(semblante_result result);

/* ---- head: a face package and its current pose ------------------------------------------------------------------- */

/* The parts of a face package. Read during the call only; everything needed is copied. */
typedef struct semblante_package {
  uint32_t size;
  uint32_t vertex_count; /* #V; with mesh_drc: 0 */
  /* The mesh: either decoded by the caller ... */
  const float* positions; /* #V by 3, model units: POSITION of mesh.drc in decoded order. May be null with
                             SEMBLANTE_HEAD_NO_VERTICES */
  const uint8_t*
      mesh_sha256; /* 32 bytes: SHA-256 of the bytes of mesh.drc; null: the pairing is checked by count only */
  const uint32_t* triangles; /* #T by 3: faces of mesh.drc in decoded order; null: no normals */
  const float* normals;      /* #V by 3: NORMAL of mesh.drc; given if and only if triangles are */
  uint32_t triangle_count;   /* #T */
  uint32_t reserved;         /* 0 */
  /* ... or its bytes, in builds with a Draco decoder (else UNSUPPORTED): all members above are zero then. */
  const uint8_t* mesh_drc;
  size_t mesh_drc_size;
  const uint8_t* weights; /* bytes of the artefact `weights` */
  size_t weights_size;
  const char* rig_json; /* bytes of rig.json, UTF-8, need not end in zero */
  size_t rig_json_size;
} semblante_package;

/* For callers that compute vertices elsewhere, such as on the GPU: no memory is used for computing them, and
 * semblante_head_positions and the like give INVALID_ARGUMENT. */
#define SEMBLANTE_HEAD_NO_VERTICES 1u

typedef struct semblante_head_options {
  uint32_t size;
  uint32_t flags;         /* SEMBLANTE_HEAD_* */
  float viseme_share;     /* share of the viseme at an FP that an expression also moves (Eq. 5); 0: that of rig.json; a
                             share of 0 is set by semblante_head_set_viseme_share */
  uint32_t jaw_takes_lip; /* 1: FAP 3 alone takes the lower lip along, as on a human face; 0: not, as in the standard.
                             FAPs of the lip itself win in both cases. */
} semblante_head_options;

/* One parametrized head and its current pose. */
typedef struct semblante_head semblante_head;

/* Makes a head in the neutral pose. `options` may be null. On failure *head is null. Errors: INVALID_ARGUMENT,
 * MALFORMED, UNSUPPORTED (a later version; mesh_drc without a decoder), MISMATCH (SHA-256 or counts of the parts
 * differ), TOO_LARGE (4 million vertices, 48 million weights), OUT_OF_MEMORY. */
semblante_result semblante_head_create(const semblante_package* package, const semblante_head_options* options,
                                       semblante_head** head, semblante_error* error);
void semblante_head_destroy(semblante_head* head);

/* 0 for null. */
uint32_t semblante_head_vertex_count(const semblante_head* head);
/* The displacement sets of FAPs 1 and 2, units and pivots of this head. Null for null. */
const semblante_rig* semblante_head_rig(const semblante_head* head);
/* Rest positions and influence table. Null for null. */
const semblante_face* semblante_head_face(const semblante_head* head);
/* #T by 3 corners, and #T; null and 0 if the package had none. */
const uint32_t* semblante_head_triangles(const semblante_head* head, uint32_t* triangle_count);
/* #V by 2, origin top left; null if mesh_drc was not given or has none. */
const float* semblante_head_uvs(const semblante_head* head);
/* #V by 3 bytes: red, green, blue of the vertices, sRGB; they multiply material and image as linear light
 * (protocol/SPEC.md, section 1.2). Null, which is white: mesh_drc was not given or has none. */
const uint8_t* semblante_head_colors(const semblante_head* head);
/* The current pose; the pointer is valid until the head is destroyed, its content changes with the pose. */
const semblante_pose* semblante_head_pose(const semblante_head* head);

/* Sets the share of the viseme at an FP that an expression also moves (Eq. 5), 0..1 inclusive. It applies to frames set
 * from now on; the current pose does not change. A player uses the share of its stream instead, if the stream has one.
 * semblante_head_rig has the current share, initially that of rig.json or of the options. INVALID_ARGUMENT, without a
 * change, for a share outside 0..1 or NaN. */
semblante_result semblante_head_set_viseme_share(semblante_head* head, float viseme_share);

/* Frame -> pose of this head (Eq. 5, 6), kept in the head. FAPs that are not finite are refused. */
semblante_result semblante_head_set_frame(semblante_head* head, const semblante_frame* frame);
/* Sets the pose at t (0..1, clamped) between two frames, for displays faster than the stream. A t that is not finite is
 * refused. */
semblante_result semblante_head_set_interpolated(semblante_head* head, const semblante_frame* from,
                                                 const semblante_frame* to, float t);
/* Gets the current pose, or sets one made by the caller (a blend, a filter). */
semblante_result semblante_head_get_pose(const semblante_head* head, semblante_pose* pose);
semblante_result semblante_head_set_pose(semblante_head* head, const semblante_pose* pose);

/* The vertices of the current pose (Eq. 7, then eyes and tongue, then head): 3 * vertex_count floats, in decoded order.
 * `capacity` is in floats. */
semblante_result semblante_head_positions(const semblante_head* head, float* positions, size_t capacity);

/* Like semblante_head_positions, if `positions` still has the result of this head in the pose `before`: writes only
 * vertices that may differ between the two poses. For speech without head motion these are about half of all. */
semblante_result semblante_head_update_positions(const semblante_head* head, const semblante_pose* before,
                                                 float* positions, size_t capacity);

/* Unit normals of `positions` from this head: both 3 * #V floats, `capacity` of `normals`. Those of the mesh, turned as
 * the triangles turn: seams stay smooth, hard edges hard. INVALID_ARGUMENT for a head without triangles and normals. */
semblante_result semblante_head_normals(const semblante_head* head, const float* positions, float* normals,
                                        size_t capacity);

/* SHA-256 of the bytes of a package's part, as rig.json names it, for programs that read packages by themselves.
 * INVALID_ARGUMENT for null, unless `size` is 0. */
semblante_result semblante_sha256(const uint8_t* bytes, size_t size, uint8_t digest[32]);

/* ---- bridges: faces of other systems ------------------------------------------------------------------------------
 */

/* ARKit's 52 blend shape coefficients, in the order of Live Link Face's stream (core/bridges/data/arkit.json), 0..1:
 * values outside are clamped. NaN and infinity are refused, and `where` names the shape. */
semblante_result semblante_frame_from_arkit(const float coefficients[52], semblante_frame* frame,
                                            semblante_error* error);
/* ARKit's coefficients for the face of a frame, each in 0..1. FAPs that are not finite are refused. */
semblante_result semblante_arkit_from_frame(const semblante_frame* frame, float coefficients[52]);
/* The 15 visemes of Oculus Lipsync, in its order, which is that of FAP 1: sets FAP 1 of the frame and clears the rest.
 */
semblante_result semblante_frame_from_oculus(const float weights[15], semblante_frame* frame, semblante_error* error);
/* The weights of a frame's viseme, at least 0, with sum 1. FAPs that are not finite are refused. */
semblante_result semblante_oculus_from_frame(const semblante_frame* frame, float weights[15]);
/* The name of an ARKit shape ("jawOpen"), 0..51; null beyond. */
const char* semblante_arkit_name(uint32_t shape);
/* The name of a viseme of Oculus Lipsync ("PP"), 0..14; null beyond. */
const char* semblante_oculus_name(uint32_t viseme);

/* A frame at a time. 296 bytes. */
typedef struct semblante_timed_frame {
  double time; /* ms */
  semblante_frame frame;
} semblante_timed_frame;

/* ---- stream: the protocol for one stream, across connections --------------------------------------------------------
 *
 * The caller owns the WebSocket (binary, subprotocol SEMBLANTE_SUBPROTOCOL, at ws://host/v1/streams/{id}) and moves
 * bytes:
 *
 *   semblante_stream_start(stream, now);
 *   loop:
 *     while (semblante_stream_next_event(stream, &event)) ...       // CONNECT: open the socket; CLOSE: close it
 *     while ((bytes = semblante_stream_take_bytes(stream, &size)))  // one binary WebSocket message each
 *     wait for the socket until semblante_stream_wake_time(stream)
 *       opened:   semblante_stream_opened(stream, now)
 *       message:  semblante_stream_receive(stream, bytes, size, now)
 *       closed:   semblante_stream_closed(stream, code, now)
 *       timeout:  semblante_stream_tick(stream, now)
 *
 * After a loss it asks for a new connection, after a pause that grows, and resumes where it stopped. */

#define SEMBLANTE_SUBPROTOCOL "semblante.v1"

typedef struct semblante_stream semblante_stream;

#define SEMBLANTE_ROLE_SUBSCRIBE 0u
#define SEMBLANTE_ROLE_PUBLISH 1u

typedef struct semblante_stream_options {
  uint32_t size;
  uint32_t role;              /* SEMBLANTE_ROLE_* */
  uint32_t take_over;         /* publisher: 1 replaces the current source of the stream */
  uint32_t max_message_bytes; /* longer messages of the server are a fault; 0 or more than 262144: 262144 */
  /* Pauses before a new connection, ms; 0: 250 and 10000. Each attempt doubles the pause up to the longest; half of it
   * is random, so that many clients do not return at one moment. */
  double retry_first, retry_longest;
  uint64_t seed;        /* of the random half */
  double ping_interval; /* longest time between pings, ms; 0: 5000; negative: none. Shorter at first */
  double silence_limit; /* a connection is lost if the server answers hello or a ping by nothing for this long, ms;
                           0: 20000; negative: never */
  double batch;         /* publisher: frames of this many ms travel in one message; 0: each publish is a message */
  /* Resume point of the first connection: 0, 0 for none. */
  uint64_t resume_epoch, resume_sequence;
  uint32_t sound; /* subscriber: 1 asks for the sound of the stream, whose packets are SOUND events; publisher: 1 if it
                     sends sound (semblante_stream_publish_sound) */
  uint32_t text;  /* subscriber: 1, the client has a voice of its own: TEXT events in place of frames and sound of
                     speech. semblante_stream_spoken changes it */
  uint32_t captions; /* subscriber: 1, the client shows what is said: TEXT events beside frames and sound.
                        semblante_stream_set_captions changes it */
  uint32_t reserved; /* 0 */
} semblante_stream_options;

typedef enum semblante_stream_state {
  SEMBLANTE_STREAM_CLOSED = 0,     /* not started, stopped, or ended for good */
  SEMBLANTE_STREAM_CONNECTING = 1, /* the caller opens a socket, or the header has not arrived yet */
  SEMBLANTE_STREAM_OPEN = 2,       /* the header has arrived */
  SEMBLANTE_STREAM_WAITING = 3     /* a new connection follows after a pause */
} semblante_stream_state;

typedef enum semblante_event_type {
  SEMBLANTE_EVENT_NONE = 0,
  SEMBLANTE_EVENT_STATE = 1,    /* `state` */
  SEMBLANTE_EVENT_CONNECT = 2,  /* open a WebSocket, then call semblante_stream_opened, or _closed if it fails */
  SEMBLANTE_EVENT_CLOSE = 3,    /* close the WebSocket with `code` and forget it: its messages and its end are not
                                   reported any more */
  SEMBLANTE_EVENT_HEADER = 4,   /* see semblante_stream_header; `resumed`, `epoch`, `sequence`, `media_time` */
  SEMBLANTE_EVENT_KEYFRAME = 5, /* one frame, after the header or in place of frames that were missed */
  SEMBLANTE_EVENT_FRAMES = 6,   /* see semblante_stream_frames; `sequence` of the first, `media_time` of the last */
  SEMBLANTE_EVENT_CLOCK = 7,    /* a ping was answered: `round_trip`, `server_offset`, `media_time` */
  SEMBLANTE_EVENT_REFUSED = 8,  /* the server refused a message: `code` (semblante_refusal), `error` */
  SEMBLANTE_EVENT_FAULT = 9,    /* a message of the server cannot be read, or it is silent: `code` (semblante_result),
                                   `error`. A new connection follows */
  SEMBLANTE_EVENT_END = 10,     /* the server ends the connection: `code` (semblante_end_reason), `is_final` */
  SEMBLANTE_EVENT_SOUND = 11,   /* a packet of sound, if it was asked for: `media_time` at which it begins to be heard,
                                   `duration`, `packet`, `packet_size` */
  SEMBLANTE_EVENT_TEXT = 12 /* a sentence for the client's own voice or its captions, if it was asked for: `sequence`
                               is its number, `text`, `language`, `media_time` at which its first word begins,
                               `duration` (of a voice of its own: estimated), and its score in `packet`,
                               `packet_size`, see semblante_score_words. An empty text: what is said stops at
                               `media_time`. Again with a known number after a new connection: go on */
} semblante_event_type;

/* Of SEMBLANTE_EVENT_HEADER. */
#define SEMBLANTE_FRESH 0u            /* a first connection, or another epoch: a new time line */
#define SEMBLANTE_RESUMED 1u          /* all frames that were missed follow */
#define SEMBLANTE_RESUMED_WITH_GAP 2u /* frames are missing; the keyframe is the newest state */

/* EndReason of the protocol. After FINISHED, DELETED and REPLACED no connection follows. */
typedef enum semblante_end_reason {
  SEMBLANTE_END_OTHER = 0,
  SEMBLANTE_END_FINISHED = 1,
  SEMBLANTE_END_DELETED = 2,
  SEMBLANTE_END_SHUTDOWN = 3,
  SEMBLANTE_END_REPLACED = 4,
  SEMBLANTE_END_SLOW = 5
} semblante_end_reason;

/* StreamErrorCode of the protocol. */
typedef enum semblante_refusal {
  SEMBLANTE_REFUSED_OTHER = 0,
  SEMBLANTE_REFUSED_MALFORMED = 1,
  SEMBLANTE_REFUSED_TRUNCATED = 2,
  SEMBLANTE_REFUSED_OUT_OF_RANGE = 3,
  SEMBLANTE_REFUSED_NOT_FINITE = 4,
  SEMBLANTE_REFUSED_TOO_LARGE = 5,
  SEMBLANTE_REFUSED_UNSUPPORTED = 6,
  SEMBLANTE_REFUSED_MISMATCH = 7,
  SEMBLANTE_REFUSED_MISSING = 8,
  SEMBLANTE_REFUSED_INVALID_ARGUMENT = 9,
  SEMBLANTE_REFUSED_NOT_FOUND = 10,
  SEMBLANTE_REFUSED_CONFLICT = 11,
  SEMBLANTE_REFUSED_THROTTLED = 12,
  SEMBLANTE_REFUSED_UNAUTHORIZED = 13,
  SEMBLANTE_REFUSED_INTERNAL = 14
} semblante_refusal;

/* Members that the type of the event does not name are zero. */
typedef struct semblante_event {
  uint32_t size;
  uint32_t type;     /* semblante_event_type */
  uint32_t state;    /* semblante_stream_state */
  uint32_t code;     /* WebSocket close code, semblante_refusal, semblante_result or semblante_end_reason */
  uint32_t resumed;  /* SEMBLANTE_FRESH ... */
  uint32_t is_final; /* 1: no connection follows */
  uint64_t epoch;
  uint64_t sequence;    /* number of the first frame */
  double media_time;    /* ms */
  double round_trip;    /* ms */
  double server_offset; /* ms: the server's wall clock (since 1970) minus `now` */
  semblante_error error;
  double duration;       /* ms */
  const uint8_t* packet; /* of the codec of semblante_header, valid until the next event is taken; else null */
  uint32_t packet_size;  /* bytes, at most 4000 */
  uint32_t reserved;
  const char* text;     /* UTF-8, zero-terminated, valid as `packet`; else null */
  const char* language; /* BCP 47, may be empty; the same */
} semblante_event;

/* SoundCodec of the protocol. */
#define SEMBLANTE_SOUND_OTHER 0u /* of a later version: the packets mean nothing to this one */
#define SEMBLANTE_SOUND_OPUS 1u  /* RFC 6716, without container; there is no pre-skip */

/* The newest header. Texts are zero-terminated UTF-8, valid until the next header. */
typedef struct semblante_header {
  uint32_t size;
  uint32_t resumed; /* SEMBLANTE_FRESH ... */
  uint64_t epoch;
  uint64_t sequence;       /* of the stream's newest frame; 0 before the first */
  double media_time;       /* ms, when the server sent the header */
  double server_time;      /* ms since 1970 */
  double frame_rate;       /* intended frames per second; 0: unknown */
  double batch_interval;   /* intended ms between messages; 0: unknown */
  double viseme_share;     /* of Eq. 5, in place of rig.json's; NaN: rig.json's */
  const char* stream;      /* id */
  const char* title;       /* for display; may be empty */
  const char* model;       /* id of the suggested model; may be empty */
  const double* quantizer; /* 69: FAP units per level by FAP number; entries 0..2 unused */
  uint32_t sound_codec;    /* SEMBLANTE_SOUND_*; of this and the next the meaning is nothing where sound_rate is 0 */
  uint32_t sound_rate;     /* samples per second; 0: the stream has no sound, or it was not asked for */
  uint32_t sound_channels;
  uint32_t sound_bitrate; /* nominal, bit/s; 0: unknown */
} semblante_header;

/* What is known of the stream's clock. */
typedef struct semblante_clock {
  uint32_t size;
  uint32_t steps;       /* how often a clock was set, or the machine slept */
  double media_time;    /* the stream's clock at `now`, ms */
  double uncertainty;   /* greatest error of media_time, ms; NaN before the first answer */
  double drift;         /* ms per ms; 0 until it is known */
  double round_trip;    /* of the newest answer, ms; NaN before */
  double server_offset; /* ms: the server's wall clock (since 1970) minus `now`; NaN before the first pong */
} semblante_clock;

/* `options` may be null: a subscriber. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
semblante_result semblante_stream_create(const semblante_stream_options* options, semblante_stream** stream,
                                         semblante_error* error);
/* Players that follow it follow nobody from then on. */
void semblante_stream_destroy(semblante_stream* stream);

/* CONNECT follows. No effect unless the stream is CLOSED or WAITING (which ends the pause). */
void semblante_stream_start(semblante_stream* stream, double now);
/* CLOSE (if there is a connection) and CLOSED follow; what was not sent is dropped. semblante_stream_start goes on from
 * where the stream stopped. */
void semblante_stream_stop(semblante_stream* stream, double now);
/* The socket is open: hello is to be sent. */
void semblante_stream_opened(semblante_stream* stream, double now);
/* One binary message of the server. Messages of a later version are skipped. INVALID_ARGUMENT only for null; what is
 * wrong with the bytes is an event. */
semblante_result semblante_stream_receive(semblante_stream* stream, const uint8_t* bytes, size_t size, double now);
/* The connection is closed, lost, or could not be opened. `code`: of the WebSocket, 0 if there is none. */
void semblante_stream_closed(semblante_stream* stream, uint32_t code, double now);
/* Does what is due: pings, new connections, batches. */
void semblante_stream_tick(semblante_stream* stream, double now);
/* The time at which tick has something to do; infinity: never. */
double semblante_stream_wake_time(const semblante_stream* stream);

/* The next message to send, valid until the next call with this stream; null: none. At most 256 KiB wait. */
const uint8_t* semblante_stream_take_bytes(semblante_stream* stream, size_t* size);
/* The next event; 0: none. Take them after each call: at most 64 wait, and beyond that the oldest of KEYFRAME, FRAMES,
 * CLOCK, REFUSED, SOUND and TEXT are dropped. `event->size` must be set. */
uint32_t semblante_stream_next_event(semblante_stream* stream, semblante_event* event);
/* The frames of the newest KEYFRAME or FRAMES event, with absolute media times, valid until the next message is
 * received; *count 0 and null if there are none. Not const: frames are converted when they are asked for. */
const semblante_timed_frame* semblante_stream_frames(semblante_stream* stream, uint32_t* count);
semblante_stream_state semblante_stream_get_state(const semblante_stream* stream);
/* UNAVAILABLE before the first header. */
semblante_result semblante_stream_header(const semblante_stream* stream, semblante_header* header);
/* UNAVAILABLE before the first message with a time. */
semblante_result semblante_stream_clock(const semblante_stream* stream, double now, semblante_clock* clock);
/* Sends several pings quickly, after a pause in which the machine may have slept. */
void semblante_stream_measure_clock(semblante_stream* stream, double now);
/* The epoch and number of the last frame received, to resume later by the options of another object; 0, 0: none. */
void semblante_stream_resume_point(const semblante_stream* stream, uint64_t* epoch, uint64_t* sequence);

/* Publishes frames. `media_time`: ms of any steady clock, whose spacing the server keeps; 0: now. The times of the
 * frames are relative to it and do not decrease; at most 10 s. The first message of a connection is a keyframe, and so
 * is the first after a refusal. UNAVAILABLE, and nothing is sent, while the stream is not OPEN or 256 KiB wait.
 * INVALID_ARGUMENT: not a publisher, count 0 or over 1024, FAPs or times that are not finite or out of range. */
semblante_result semblante_stream_publish(semblante_stream* stream, const semblante_timed_frame* frames, uint32_t count,
                                          double media_time, double now);
/* Publishes one Opus packet of at most 4000 bytes and 120 ms, without pre-skip, whose first sample is heard at
 * `media_time`, ms of the clock of the frames; packets do not overlap. UNAVAILABLE, and nothing is sent, while the
 * stream is not OPEN or 256 KiB wait, and where the header names no sound. INVALID_ARGUMENT: not a publisher whose
 * options have `sound`, no Opus packet, a time out of range. */
semblante_result semblante_stream_publish_sound(semblante_stream* stream, const uint8_t* packet, uint32_t size,
                                                double media_time);

/* VoiceState of the protocol. */
typedef enum semblante_voice_state {
  SEMBLANTE_VOICE_REACHED = 0, /* it begins the word at `character` */
  SEMBLANTE_VOICE_ENDED = 1,   /* it has said the text, or was silenced */
  SEMBLANTE_VOICE_FAILED = 2,  /* it cannot speak: frames from now on, also after a new connection */
  SEMBLANTE_VOICE_READY = 3    /* it can speak: TEXT events from now on, also after a new connection */
} semblante_voice_state;

/* Tells the server what the client's own voice does. `speech`: `sequence` of the TEXT event, 0: none; `character`: code
 * points of the text before the place. UNAVAILABLE, and nothing is sent, while the stream is not OPEN or 256 KiB wait;
 * FAILED and READY are then told as soon as it is OPEN, and hold for later connections. INVALID_ARGUMENT: not a
 * subscriber, an unknown state, a character over 2000. */
semblante_result semblante_stream_spoken(semblante_stream* stream, uint32_t state, uint64_t speech, uint32_t character,
                                         double now);

/* Whether TEXT events come beside the frames and the sound of speech, for captions; also after a new connection. OK,
 * also when the server is told only when the stream is OPEN. INVALID_ARGUMENT: not a subscriber. */
semblante_result semblante_stream_set_captions(semblante_stream* stream, uint32_t on);

/* When the words of a score (TEXT events) begin, ms after `media_time`: those between spaces, tabs and ends of lines of
 * the text, in order. `count` is the capacity of `times`, then the number of words; BUFFER_TOO_SMALL, and those that
 * fit, if there are more. `times` may be null to ask. INVALID_ARGUMENT: no score. */
semblante_result semblante_score_words(const uint8_t* score, uint32_t size, double* times, uint32_t* count);

/* ---- player: frames of a stream -> the pose to show now
 * -------------------------------------------------------------- */

typedef struct semblante_player semblante_player;

typedef struct semblante_player_options {
  uint32_t size;
  uint32_t eased;      /* 1: smooth curves between frames, which need one more frame ahead; 0: lines, as in the paper */
  double delay;        /* ms behind the stream's clock; 0: as short as the network allows, adapted continuously */
  uint32_t max_frames; /* frames held while nothing is shown; 0: 2048. Beyond it the older half is dropped */
  uint32_t reserved;   /* 0 */
} semblante_player_options;

typedef struct semblante_player_statistics {
  uint32_t size;
  uint32_t held;       /* frames held */
  double delay;        /* behind the stream's clock, ms; NaN before the first frame */
  double wanted_delay; /* what the delay moves to, ms */
  double jitter;       /* mean change of the transit time from one message to the next, ms (RFC 3550) */
  double error;        /* shown minus wanted media time, ms; below 0 while the newest frame is held */
  double starved_time; /* sum of the time without a newer frame, ms */
  uint64_t starved;    /* how often frames arrived too late */
  uint64_t snaps;      /* how often the shown time jumped */
} semblante_player_statistics;

/* `options` may be null. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
semblante_result semblante_player_create(const semblante_player_options* options, semblante_player** player,
                                         semblante_error* error);
void semblante_player_destroy(semblante_player* player);

/* From now on the stream hands its headers and frames to the player, and the player uses its clock and viseme share.
 * Null: follows nobody. Several players may follow one stream; destroying either ends it. OUT_OF_MEMORY. */
semblante_result semblante_player_follow(semblante_player* player, semblante_stream* stream);
/* Frames without a stream, by rising absolute time in ms; those not after the newest are left out. Values are kept to
 * an eighth of the standard's quantizer steps. INVALID_ARGUMENT: numbers that are not finite; the player follows a
 * stream. */
semblante_result semblante_player_push(semblante_player* player, const semblante_timed_frame* frames, uint32_t count,
                                       double now);
/* Advances to the display frame at `now`, which is `elapsed` ms after the one before by the display's own rate (0 or
 * more; if it contradicts `now` by more than 50 ms, or is negative, the time since the last call is used). After 5 s
 * without a call the clock of the stream is measured again. Returns 1 when there is something to show. */
uint32_t semblante_player_advance(semblante_player* player, double now, double elapsed);
/* In place of semblante_player_advance with an external clock, such as the position of a sound: moves to that media
 * time, limited to the frames held. Backwards by up to half a second it waits. Returns 1 when there is something to
 * show. */
uint32_t semblante_player_move_to(semblante_player* player, double media_time);
/* Sets the pose of a head to the current moment of the player. Several heads may be shown by one player, and by several
 * threads. Returns 1 if the pose changed. */
uint32_t semblante_player_show(const semblante_player* player, semblante_head* head);
/* The current moment as two frames and the position between them, 0..1, for callers without a head. UNAVAILABLE before
 * the first frame. */
semblante_result semblante_player_between(const semblante_player* player, semblante_timed_frame* from,
                                          semblante_timed_frame* to, float* t);
/* The current moment with everything that decides the pose, for callers who evaluate frames themselves. */
typedef struct semblante_moment {
  uint32_t size;
  uint32_t is_curve; /* 1: semblante_ease through the four frames; 0: semblante_interpolate between the middle two */
  double from_time;  /* media times of frames 1 and 2, ms: equal if there is one frame only */
  double to_time;
  double viseme_share;       /* of Eq. 5, in place of rig.json's; NaN: rig.json's */
  float t;                   /* from frame 1 to frame 2, 0..1 */
  float spans[3];            /* of a curve, as semblante_ease takes them; 0: that frame is absent */
  semblante_frame frames[4]; /* before, from, to, after */
} semblante_moment;

/* UNAVAILABLE before the first frame. */
semblante_result semblante_player_moment(const semblante_player* player, semblante_moment* moment);
/* The media time to show, ms; NaN before the first frame. */
double semblante_player_time(const semblante_player* player);
semblante_result semblante_player_stats(const semblante_player* player, semblante_player_statistics* statistics);
/* Drops all frames; the pose of heads stays. */
void semblante_player_clear(semblante_player* player);

/* ---- performances: documents that describe a face over time
 * ------------------------------------------------------------ */

typedef struct semblante_performance semblante_performance;

/* Reads a performance document (protocol/SPEC.md, section 9), at most 16 MiB. Errors: MALFORMED with the JSON pointer,
 * UNSUPPORTED, TOO_LARGE, OUT_OF_MEMORY. */
semblante_result semblante_performance_create(const char* json, size_t size, semblante_performance** performance,
                                              semblante_error* error);
void semblante_performance_destroy(semblante_performance* performance);
/* For display; zero-terminated. Null for null. */
const char* semblante_performance_name(const semblante_performance* performance);
/* ms; 0: endless. */
double semblante_performance_duration(const semblante_performance* performance);
/* The face at `ms` after the start. `idle_ms`: time of idle life, which a loop of the cues does not restart; usually
 * the same. Both 0 to 9e15. */
semblante_result semblante_performance_frame_at(const semblante_performance* performance, double ms, double idle_ms,
                                                semblante_frame* frame);

/* ---- takes: files of recorded motion
 * ------------------------------------------------------------------------------------- */

typedef struct semblante_take semblante_take;

typedef enum semblante_take_format {
  SEMBLANTE_TAKE_FAP = 0,          /* .fap: protocol/FAP_FILE.md */
  SEMBLANTE_TAKE_LIVE_LINK_CSV = 1 /* CSV of the app Live Link Face: ARKit's shapes, head and eyes */
} semblante_take_format;

/* How a .fap file is understood; without meaning for other formats. */
typedef struct semblante_take_options {
  uint32_t size;
  uint32_t absent; /* the value of a FAP that a frame omits. 0: zero; 1: that of the frame before */
  uint32_t gaps;   /* the motion where frame numbers are left out. 0: the face holds still; 1: it is interpolated */
} semblante_take_options;

/* A deviation from the format that was accepted. */
typedef struct semblante_take_warning {
  uint32_t size;
  uint32_t oddity;   /* FAP: the index of FapFileOddity in protocol/cpp/fap_file.h; else 0 */
  uint32_t line;     /* the first line with it, from 1; 0: unknown */
  uint32_t count;    /* number of such lines or values; 0: unknown */
  char message[256]; /* for display */
} semblante_take_warning;

/* Reads a file of at most 64 MiB. `options` may be null. Errors: MALFORMED with line and word, TOO_LARGE,
 * INVALID_ARGUMENT, OUT_OF_MEMORY. */
semblante_result semblante_take_read(uint32_t format, const char* text, size_t size,
                                     const semblante_take_options* options, semblante_take** take,
                                     semblante_error* error);
void semblante_take_destroy(semblante_take* take);
/* By rising time from the start, ms. */
const semblante_timed_frame* semblante_take_frames(const semblante_take* take, uint32_t* count);
/* Frames per second, of the file if it says so, else by the mean distance of the frames. */
double semblante_take_frame_rate(const semblante_take* take);
uint32_t semblante_take_warning_count(const semblante_take* take);
semblante_result semblante_take_get_warning(const semblante_take* take, uint32_t index,
                                            semblante_take_warning* warning);
/* Writes a file from frames by rising time. `rate`: frames per second of the file, 0.001..1000; 0: by the times. *size
 * is the capacity of `text` in bytes, then what the file needs, without a zero at its end. BUFFER_TOO_SMALL if that is
 * more; `text` may be null to ask. INVALID_ARGUMENT, TOO_LARGE, OUT_OF_MEMORY. */
semblante_result semblante_take_write(uint32_t format, const semblante_timed_frame* frames, uint32_t count, double rate,
                                      char* text, size_t* size, semblante_error* error);

/* ---- listeners: the sound of speech -> visemes, while it goes on
 * ------------------------------------------------------------------------------------- */

typedef struct semblante_listener semblante_listener;

/* From a moment of the sound to the last sample that is heard for it, ms. */
#define SEMBLANTE_LISTENER_DELAY_MS 52.5

typedef struct semblante_listener_options {
  uint32_t size;
  uint32_t sample_rate; /* Hz, 8000 to 192000 */
} semblante_listener_options;

/* What is heard in 10 ms. Visemes are those of FAP 1, and of Oculus, in their order: semblante_frame_from_oculus makes
 * a frame of the weights. */
typedef struct semblante_heard {
  uint32_t size;
  float level;                           /* dB of full scale */
  double time;                           /* the middle of the 10 ms: ms after the first sample */
  float weights[SEMBLANTE_VISEME_COUNT]; /* what a mouth shows: without flicker, vowels opened by loudness; 1 in all */
  float probability[SEMBLANTE_VISEME_COUNT]; /* as it was heard; 1 in all */
} semblante_heard;

/* A listener knows no language. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
semblante_result semblante_listener_create(const semblante_listener_options* options, semblante_listener** listener,
                                           semblante_error* error);
void semblante_listener_destroy(semblante_listener* listener);
/* Takes samples of one channel, of full scale 1, until the next 10 ms have been heard; *taken of them, so that the rest
 * is for the next call. Values that are not finite are taken as 0. UNAVAILABLE: all were taken, and nothing new was
 * heard; `heard` is not written. INVALID_ARGUMENT: a null, or a `size` that is too small. */
semblante_result semblante_listener_push(semblante_listener* listener, const float* samples, uint32_t count,
                                         uint32_t* taken, semblante_heard* heard);

/* ---- speakers: the face of a client whose own voice speaks ----------------------------------------------------------
 *
 * For TEXT events of a stream. When the voice begins a text, _say; when it begins a word, _reach; when it is silent,
 * _end; for each picture, _show on the frame that the stream last had. A voice that tells no words is followed by the
 * times of the score. */

typedef struct semblante_speaker semblante_speaker;

/* `seed`: of its blinks, nods and glances. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
semblante_result semblante_speaker_create(uint32_t seed, semblante_speaker** speaker, semblante_error* error);
void semblante_speaker_destroy(semblante_speaker* speaker);
/* The voice begins at word number `first_word` (from 0; words are what is between spaces, tabs and ends of lines).
 * INVALID_ARGUMENT: a null, or bytes that are no score. */
semblante_result semblante_speaker_say(semblante_speaker* speaker, const uint8_t* score, size_t size,
                                       uint32_t first_word, double now);
/* Words that the score does not have, or before one that was reached, have no effect. */
void semblante_speaker_reach(semblante_speaker* speaker, uint32_t word, double now);
void semblante_speaker_end(semblante_speaker* speaker, double now);
/* Sets viseme, expression and lids of the frame, and adds nods, raised brows and glances to its head, brows and eyes.
 * Returns 0 and leaves it when nothing is said and the face has come to rest, and for FAPs that are not finite. */
uint32_t semblante_speaker_show(semblante_speaker* speaker, double now, semblante_frame* frame);
/* The plain form of a packed text (protocol/SPEC.md, "Packed text"). For pages, whose streams and speakers are two
 * modules of WebAssembly: elsewhere a stream does it by itself. Returns its size, at most 6,100 bytes; 0: these are no
 * packed text, or `capacity` is too small. */
size_t semblante_speaker_unpack(const uint8_t* packed, size_t size, uint8_t* plain, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
