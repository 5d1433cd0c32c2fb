/* libsemblante in Godot 3 by GDNative: one face that follows one stream. face.gd calls these functions by name; each
 * takes the array of its arguments and returns one value.
 *
 * Godot's headers are not packaged. What is needed of them is declared here: an opaque value has the size that it has
 * in Godot 3, and a function of the core API has the number that it has in version 1.0 of the API, which never changes.
 */
#include <stdint.h>
#include <string.h>

#include <semblante/semblante.h>

#define EXPORT __attribute__((visibility("default")))

typedef struct variant {
  uint64_t opaque[3];
} variant;
typedef struct array {
  uint64_t opaque;
} array; /* an Array, or one of the pool arrays */

typedef struct core_api {
  unsigned type, major, minor;
  const void* next;
  unsigned extension_count;
  const void* const* extensions;
  void (*function[744])(void);
} core_api;

typedef struct init_options {
  uint8_t in_editor; /* a bool */
  uint64_t core_hash, editor_hash, no_api_hash;
  void (*report_version_mismatch)(void);
  void (*report_loading_error)(void);
  void* library;
  const core_api* core;
  const void* path;
} init_options;

static const core_api* core;

#define CALL(number, result, arguments) ((result(*) arguments)(core->function[number]))
#define array_size CALL(356, int, (const array*))
#define array_get CALL(333, variant, (const array*, int))
#define variant_nil CALL(509, void, (variant*))
#define variant_int CALL(512, void, (variant*, int64_t))
#define variant_bytes CALL(530, void, (variant*, const array*))
#define variant_ints CALL(531, void, (variant*, const array*))
#define variant_vectors CALL(535, void, (variant*, const array*))
#define variant_colors CALL(536, void, (variant*, const array*))
#define as_real CALL(540, double, (const variant*))
#define as_bytes CALL(557, array, (const variant*))
#define variant_free CALL(570, void, (variant*))
#define bytes_read CALL(165, void*, (const array*))
#define bytes_read_at CALL(268, const uint8_t*, (const void*))
#define bytes_read_end CALL(270, void, (void*))
#define bytes_size CALL(169, int, (const array*))

/* The numbers of one kind of pool array. */
typedef struct pool {
  int create, resize, write, at, end, destroy;
} pool;
static const pool bytes_pool = {155, 164, 166, 296, 298, 170};
static const pool ints_pool = {171, 180, 182, 300, 302, 186};
static const pool vectors_pool = {235, 244, 246, 316, 318, 250};
static const pool colors_pool = {251, 260, 262, 320, 322, 266};

/* A pool array of `count` elements that are `bytes` at `from` together. */
static array pool_of(const pool* kind, int count, const void* from, size_t bytes) {
  array made;
  CALL(kind->create, void, (array*))(&made);
  CALL(kind->resize, void, (array*, int))(&made, count);
  void* const access = CALL(kind->write, void*, (array*))(&made);
  if (bytes > 0) memcpy(CALL(kind->at, void*, (const void*))(access), from, bytes);
  CALL(kind->end, void, (void*))(access);
  return made;
}

static variant integer(int64_t value) {
  variant made;
  variant_int(&made, value);
  return made;
}

static double real_argument(const array* arguments, int index) {
  variant value = array_get(arguments, index);
  const double real = as_real(&value);
  variant_free(&value);
  return real;
}

/* An argument that is a PoolByteArray, readable until bytes_end. */
typedef struct bytes {
  array held;
  void* access;
  const uint8_t* at;
  size_t size;
} bytes;

static bytes bytes_argument(const array* arguments, int index) {
  bytes read;
  variant value = array_get(arguments, index);
  read.held = as_bytes(&value);
  variant_free(&value);
  read.access = bytes_read(&read.held);
  read.at = bytes_read_at(read.access);
  read.size = (size_t)bytes_size(&read.held);
  return read;
}

static void bytes_end(bytes* read) {
  bytes_read_end(read->access);
  CALL(bytes_pool.destroy, void, (array*))(&read->held);
}

static semblante_head* head;
static semblante_stream* stream;
static semblante_player* player;
static semblante_event event; /* the newest that was taken */

static void forget(void) {
  semblante_player_destroy(player);
  semblante_stream_destroy(stream);
  semblante_head_destroy(head);
  player = NULL;
  stream = NULL;
  head = NULL;
}

EXPORT void semblante_gdnative_init(init_options* options) { core = options->core; }
EXPORT void semblante_gdnative_terminate(void* options) {
  (void)options;
  forget();
}

/* (mesh.drc, weights, rig.json) -> number of vertices; 0 or less: minus the semblante_result. */
EXPORT variant face_load(array* arguments) {
  if (array_size(arguments) != 3) return integer(-SEMBLANTE_INVALID_ARGUMENT);
  forget();
  bytes mesh = bytes_argument(arguments, 0);
  bytes weights = bytes_argument(arguments, 1);
  bytes rig = bytes_argument(arguments, 2);
  semblante_package package;
  memset(&package, 0, sizeof package);
  package.size = sizeof package;
  package.mesh_drc = mesh.at;
  package.mesh_drc_size = mesh.size;
  package.weights = weights.at;
  package.weights_size = weights.size;
  package.rig_json = (const char*)rig.at;
  package.rig_json_size = rig.size;
  semblante_result result = semblante_head_create(&package, NULL, &head, NULL);
  bytes_end(&mesh);
  bytes_end(&weights);
  bytes_end(&rig);
  if (result == SEMBLANTE_OK) result = semblante_stream_create(NULL, &stream, NULL);
  if (result == SEMBLANTE_OK) result = semblante_player_create(NULL, &player, NULL);
  if (result == SEMBLANTE_OK) result = semblante_player_follow(player, stream);
  if (result == SEMBLANTE_OK) return integer(semblante_head_vertex_count(head));
  forget();
  return integer(-(int64_t)result);
}

/* () -> three vertex numbers of each triangle. */
EXPORT variant face_triangles(array* arguments) {
  (void)arguments;
  uint32_t count = 0;
  const uint32_t* corners = head != NULL ? semblante_head_triangles(head, &count) : NULL;
  variant made;
  array triangles = pool_of(&ints_pool, (int)(3 * count), corners, 3 * (size_t)count * sizeof *corners);
  variant_ints(&made, &triangles);
  CALL(ints_pool.destroy, void, (array*))(&triangles);
  return made;
}

/* () -> the colours of the vertices, sRGB; empty: they have none. */
EXPORT variant face_colors(array* arguments) {
  (void)arguments;
  variant made;
  const uint8_t* from = head != NULL ? semblante_head_colors(head) : NULL;
  const uint32_t count = from != NULL ? semblante_head_vertex_count(head) : 0;
  array colors = pool_of(&colors_pool, (int)count, NULL, 0);
  void* const access = CALL(colors_pool.write, void*, (array*))(&colors);
  float* to = CALL(colors_pool.at, void*, (const void*))(access); /* red, green, blue, opacity */
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t k = 0; k < 3; ++k) to[4 * i + k] = (float)from[3 * i + k] / 255.0f;
    to[4 * i + 3] = 1.0f;
  }
  CALL(colors_pool.end, void, (void*))(access);
  variant_colors(&made, &colors);
  CALL(colors_pool.destroy, void, (array*))(&colors);
  return made;
}

/* () -> the vertices of the current pose. */
EXPORT variant face_positions(array* arguments) {
  (void)arguments;
  variant made;
  const uint32_t count = head != NULL ? semblante_head_vertex_count(head) : 0;
  array positions = pool_of(&vectors_pool, (int)count, NULL, 0);
  void* const access = CALL(vectors_pool.write, void*, (array*))(&positions);
  if (count > 0) semblante_head_positions(head, CALL(vectors_pool.at, void*, (const void*))(access), 3 * (size_t)count);
  CALL(vectors_pool.end, void, (void*))(access);
  variant_vectors(&made, &positions);
  CALL(vectors_pool.destroy, void, (array*))(&positions);
  return made;
}

/* (what, now): 0 start, 1 the socket is open, 2 it is closed or failed, 3 time passes. Times in ms. */
EXPORT variant stream_tell(array* arguments) {
  variant nothing;
  variant_nil(&nothing);
  if (stream == NULL || array_size(arguments) != 2) return nothing;
  const double now = real_argument(arguments, 1);
  switch ((int)real_argument(arguments, 0)) {
    case 0:
      semblante_stream_start(stream, now);
      break;
    case 1:
      semblante_stream_opened(stream, now);
      break;
    case 2:
      semblante_stream_closed(stream, 0, now);
      break;
    default:
      if (semblante_stream_wake_time(stream) <= now) semblante_stream_tick(stream, now);
  }
  return nothing;
}

/* (message, now) */
EXPORT variant stream_receive(array* arguments) {
  variant nothing;
  variant_nil(&nothing);
  if (stream == NULL || array_size(arguments) != 2) return nothing;
  bytes message = bytes_argument(arguments, 0);
  semblante_stream_receive(stream, message.at, message.size, real_argument(arguments, 1));
  bytes_end(&message);
  return nothing;
}

/* () -> the next message to send; empty: none. */
EXPORT variant stream_take(array* arguments) {
  (void)arguments;
  variant made;
  size_t size = 0;
  const uint8_t* message = stream != NULL ? semblante_stream_take_bytes(stream, &size) : NULL;
  array taken = pool_of(&bytes_pool, (int)size, message, message != NULL ? size : 0);
  variant_bytes(&made, &taken);
  CALL(bytes_pool.destroy, void, (array*))(&taken);
  return made;
}

/* () -> the semblante_event_type of the next event; 0: none. */
EXPORT variant stream_event(array* arguments) {
  (void)arguments;
  memset(&event, 0, sizeof event);
  event.size = sizeof event;
  if (stream == NULL || semblante_stream_next_event(stream, &event) == 0) return integer(0);
  return integer(event.type);
}

/* (now, elapsed) -> 1: the pose has changed, ask for the positions. */
EXPORT variant face_show(array* arguments) {
  if (player == NULL || array_size(arguments) != 2) return integer(0);
  if (semblante_player_advance(player, real_argument(arguments, 0), real_argument(arguments, 1)) == 0)
    return integer(0);
  return integer(semblante_player_show(player, head));
}
