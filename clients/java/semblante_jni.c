/* The native methods of semblante/Native.java: clients/runtime/semblante.h by JNI. Compile it with the library's header
 * and link it with libsemblante. A frame is 76 floats: viseme1, viseme2, viseme_blend, expression1, intensity1,
 * expression2, intensity2, then fap[0..68]. Failures are thrown as semblante.SemblanteException. */
#include <jni.h>
#include <stdlib.h>
#include <string.h>

#include <semblante/semblante.h>

enum { HIGH_LEVEL = 7, FAPS = 69, FRAME = HIGH_LEVEL + FAPS };

#define NATIVE(result, name) JNIEXPORT result JNICALL Java_semblante_Native_##name
#define HANDLE(type, at) ((type*)(intptr_t)(at))

/* NewStringUTF reads Java's own UTF-8, which has no characters of four bytes, and Android ends the process for others.
 * What the library tells has words of servers and files. */
static jstring text_of(JNIEnv* env, const char* utf8) {
  const jsize size = (jsize)strlen(utf8);
  jbyteArray bytes = (*env)->NewByteArray(env, size);
  jclass type = bytes == NULL ? NULL : (*env)->FindClass(env, "java/lang/String");
  jmethodID make = type == NULL ? NULL : (*env)->GetMethodID(env, type, "<init>", "([BLjava/lang/String;)V");
  jstring encoding = make == NULL ? NULL : (*env)->NewStringUTF(env, "UTF-8");
  if (encoding == NULL) return NULL;
  (*env)->SetByteArrayRegion(env, bytes, 0, size, (const jbyte*)utf8);
  return (jstring)(*env)->NewObject(env, type, make, bytes, encoding);
}

static void throw_failure(JNIEnv* env, semblante_result result, const semblante_error* error) {
  jclass type = (*env)->FindClass(env, "semblante/SemblanteException");
  if (type == NULL) return;
  jmethodID make =
      (*env)->GetMethodID(env, type, "<init>", "(Ljava/lang/String;Ljava/lang/String;Ljava/lang/String;)V");
  const char* code = semblante_result_name(result);
  if (make == NULL) return;
  jstring name = text_of(env, code);
  jstring where = name == NULL ? NULL : text_of(env, error != NULL ? error->where : "");
  jstring message =
      where == NULL ? NULL : text_of(env, error != NULL && error->message[0] != 0 ? error->message : code);
  if (message == NULL) return;
  jobject thrown = (*env)->NewObject(env, type, make, name, where, message);
  if (thrown != NULL) (*env)->Throw(env, (jthrowable)thrown);
}

static void check(JNIEnv* env, semblante_result result) {
  if (result != SEMBLANTE_OK) throw_failure(env, result, NULL);
}

static uint8_t byte_of(float value) { return (uint8_t)(value >= 0 && value <= 255 ? value : 255); }

static semblante_frame frame_of(const float* numbers) {
  semblante_frame frame;
  memset(&frame, 0, sizeof frame);
  frame.viseme1 = byte_of(numbers[0]);
  frame.viseme2 = byte_of(numbers[1]);
  frame.viseme_blend = byte_of(numbers[2]);
  frame.expression1 = byte_of(numbers[3]);
  frame.intensity1 = byte_of(numbers[4]);
  frame.expression2 = byte_of(numbers[5]);
  frame.intensity2 = byte_of(numbers[6]);
  memcpy(frame.fap, numbers + HIGH_LEVEL, sizeof frame.fap);
  return frame;
}

static void put_frame(JNIEnv* env, const semblante_frame* frame, jfloatArray to) {
  const float high[HIGH_LEVEL] = {frame->viseme1,    frame->viseme2,     frame->viseme_blend, frame->expression1,
                                  frame->intensity1, frame->expression2, frame->intensity2};
  (*env)->SetFloatArrayRegion(env, to, 0, HIGH_LEVEL, high);
  (*env)->SetFloatArrayRegion(env, to, HIGH_LEVEL, FAPS, frame->fap);
}

/* ---- heads */

NATIVE(jlong, headCreate)(JNIEnv* env, jclass type, jbyteArray mesh, jbyteArray weights, jbyteArray rig, jboolean lip) {
  (void)type;
  jbyte* parts[3] = {(*env)->GetByteArrayElements(env, mesh, NULL), (*env)->GetByteArrayElements(env, weights, NULL),
                     (*env)->GetByteArrayElements(env, rig, NULL)};
  semblante_head* head = NULL;
  if (parts[0] != NULL && parts[1] != NULL && parts[2] != NULL) {
    semblante_package package;
    semblante_head_options options;
    semblante_error error;
    memset(&package, 0, sizeof package);
    memset(&options, 0, sizeof options);
    memset(&error, 0, sizeof error);
    package.size = sizeof package;
    package.mesh_drc = (const uint8_t*)parts[0];
    package.mesh_drc_size = (size_t)(*env)->GetArrayLength(env, mesh);
    package.weights = (const uint8_t*)parts[1];
    package.weights_size = (size_t)(*env)->GetArrayLength(env, weights);
    package.rig_json = (const char*)parts[2];
    package.rig_json_size = (size_t)(*env)->GetArrayLength(env, rig);
    options.size = sizeof options;
    options.jaw_takes_lip = lip != JNI_FALSE;
    const semblante_result result = semblante_head_create(&package, &options, &head, &error);
    if (result != SEMBLANTE_OK) throw_failure(env, result, &error);
  }
  jbyteArray arrays[3] = {mesh, weights, rig};
  for (int i = 0; i < 3; ++i)
    if (parts[i] != NULL) (*env)->ReleaseByteArrayElements(env, arrays[i], parts[i], JNI_ABORT);
  return (jlong)(intptr_t)head;
}

NATIVE(void, headDestroy)(JNIEnv* env, jclass type, jlong head) {
  (void)env, (void)type;
  semblante_head_destroy(HANDLE(semblante_head, head));
}

NATIVE(jint, headVertexCount)(JNIEnv* env, jclass type, jlong head) {
  (void)env, (void)type;
  return (jint)semblante_head_vertex_count(HANDLE(semblante_head, head));
}

NATIVE(jintArray, headTriangles)(JNIEnv* env, jclass type, jlong head) {
  (void)type;
  uint32_t count = 0;
  const uint32_t* corners = semblante_head_triangles(HANDLE(semblante_head, head), &count);
  jintArray triangles = (*env)->NewIntArray(env, (jsize)(3 * count));
  if (triangles != NULL) (*env)->SetIntArrayRegion(env, triangles, 0, (jsize)(3 * count), (const jint*)corners);
  return triangles;
}

NATIVE(jfloatArray, headUvs)(JNIEnv* env, jclass type, jlong head) {
  (void)type;
  const float* from = semblante_head_uvs(HANDLE(semblante_head, head));
  const jsize count = (jsize)(2 * semblante_head_vertex_count(HANDLE(semblante_head, head)));
  jfloatArray uvs = from == NULL ? NULL : (*env)->NewFloatArray(env, count);
  if (uvs != NULL) (*env)->SetFloatArrayRegion(env, uvs, 0, count, from);
  return uvs;
}

NATIVE(jbyteArray, headColors)(JNIEnv* env, jclass type, jlong head) {
  (void)type;
  const uint8_t* from = semblante_head_colors(HANDLE(semblante_head, head));
  const jsize count = (jsize)(3 * semblante_head_vertex_count(HANDLE(semblante_head, head)));
  jbyteArray colors = from == NULL ? NULL : (*env)->NewByteArray(env, count);
  if (colors != NULL) (*env)->SetByteArrayRegion(env, colors, 0, count, (const jbyte*)from);
  return colors;
}

NATIVE(void, headSetFrame)(JNIEnv* env, jclass type, jlong head, jfloatArray numbers) {
  (void)type;
  float values[FRAME];
  (*env)->GetFloatArrayRegion(env, numbers, 0, FRAME, values);
  if ((*env)->ExceptionCheck(env)) return;
  const semblante_frame frame = frame_of(values);
  check(env, semblante_head_set_frame(HANDLE(semblante_head, head), &frame));
}

NATIVE(void, headPositions)(JNIEnv* env, jclass type, jlong head, jfloatArray to) {
  (void)type;
  const size_t capacity = (size_t)(*env)->GetArrayLength(env, to);
  float* positions = (*env)->GetPrimitiveArrayCritical(env, to, NULL);
  if (positions == NULL) return;
  const semblante_result result = semblante_head_positions(HANDLE(semblante_head, head), positions, capacity);
  (*env)->ReleasePrimitiveArrayCritical(env, to, positions, 0);
  check(env, result);
}

NATIVE(void, headNormals)(JNIEnv* env, jclass type, jlong head, jfloatArray positions, jfloatArray to) {
  (void)type;
  const size_t capacity = (size_t)(*env)->GetArrayLength(env, to);
  const size_t given = (size_t)(*env)->GetArrayLength(env, positions);
  if (given < 3 * (size_t)semblante_head_vertex_count(HANDLE(semblante_head, head))) {
    check(env, SEMBLANTE_INVALID_ARGUMENT);
    return;
  }
  float* from = (*env)->GetPrimitiveArrayCritical(env, positions, NULL);
  float* normals = from == NULL ? NULL : (*env)->GetPrimitiveArrayCritical(env, to, NULL);
  semblante_result result = SEMBLANTE_OUT_OF_MEMORY;
  if (normals != NULL) {
    result = semblante_head_normals(HANDLE(semblante_head, head), from, normals, capacity);
    (*env)->ReleasePrimitiveArrayCritical(env, to, normals, 0);
  }
  if (from != NULL) (*env)->ReleasePrimitiveArrayCritical(env, positions, from, JNI_ABORT);
  if (!(*env)->ExceptionCheck(env)) check(env, result);
}

/* ---- streams */

NATIVE(jlong, streamCreate)
(JNIEnv* env, jclass type, jboolean publish, jboolean takeOver, jdouble batch, jboolean sound, jlong seed) {
  (void)type;
  semblante_stream_options options;
  semblante_error error;
  semblante_stream* stream = NULL;
  memset(&options, 0, sizeof options);
  memset(&error, 0, sizeof error);
  options.size = sizeof options;
  options.role = publish != JNI_FALSE ? SEMBLANTE_ROLE_PUBLISH : SEMBLANTE_ROLE_SUBSCRIBE;
  options.take_over = takeOver != JNI_FALSE;
  options.batch = batch;
  options.sound = sound != JNI_FALSE;
  options.seed = (uint64_t)seed;
  const semblante_result result = semblante_stream_create(&options, &stream, &error);
  if (result != SEMBLANTE_OK) throw_failure(env, result, &error);
  return (jlong)(intptr_t)stream;
}

#define STREAM_CALL(name, function)                                          \
  NATIVE(void, name)(JNIEnv * env, jclass type, jlong stream, jdouble now) { \
    (void)env, (void)type;                                                   \
    function(HANDLE(semblante_stream, stream), now);                         \
  }
STREAM_CALL(streamStart, semblante_stream_start)
STREAM_CALL(streamStop, semblante_stream_stop)
STREAM_CALL(streamOpened, semblante_stream_opened)
STREAM_CALL(streamTick, semblante_stream_tick)

NATIVE(void, streamDestroy)(JNIEnv* env, jclass type, jlong stream) {
  (void)env, (void)type;
  semblante_stream_destroy(HANDLE(semblante_stream, stream));
}

NATIVE(void, streamClosed)(JNIEnv* env, jclass type, jlong stream, jint code, jdouble now) {
  (void)env, (void)type;
  semblante_stream_closed(HANDLE(semblante_stream, stream), (uint32_t)code, now);
}

NATIVE(jdouble, streamWakeTime)(JNIEnv* env, jclass type, jlong stream) {
  (void)env, (void)type;
  return semblante_stream_wake_time(HANDLE(semblante_stream, stream));
}

NATIVE(void, streamReceive)(JNIEnv* env, jclass type, jlong stream, jbyteArray message, jdouble now) {
  (void)type;
  jbyte* bytes = (*env)->GetByteArrayElements(env, message, NULL);
  if (bytes == NULL) return;
  const size_t size = (size_t)(*env)->GetArrayLength(env, message);
  const semblante_result result =
      semblante_stream_receive(HANDLE(semblante_stream, stream), (const uint8_t*)bytes, size, now);
  (*env)->ReleaseByteArrayElements(env, message, bytes, JNI_ABORT);
  check(env, result);
}

NATIVE(jbyteArray, streamTakeBytes)(JNIEnv* env, jclass type, jlong stream) {
  (void)type;
  size_t size = 0;
  const uint8_t* bytes = semblante_stream_take_bytes(HANDLE(semblante_stream, stream), &size);
  jbyteArray taken = bytes == NULL ? NULL : (*env)->NewByteArray(env, (jsize)size);
  if (taken != NULL) (*env)->SetByteArrayRegion(env, taken, 0, (jsize)size, (const jbyte*)bytes);
  return taken;
}

/* A TEXT event: the text, its language, and the times of its words. */
static void set_said(JNIEnv* env, jobjectArray said, const semblante_event* event) {
  uint32_t count = 0;
  semblante_score_words(event->packet, event->packet_size, NULL, &count);
  jdoubleArray times = (*env)->NewDoubleArray(env, (jsize)count);
  jdouble* first = times == NULL ? NULL : (*env)->GetDoubleArrayElements(env, times, NULL);
  if (first == NULL) return;
  semblante_score_words(event->packet, event->packet_size, first, &count);
  (*env)->ReleaseDoubleArrayElements(env, times, first, 0);
  (*env)->SetObjectArrayElement(env, said, 0, text_of(env, event->text));
  (*env)->SetObjectArrayElement(env, said, 1, text_of(env, event->language));
  (*env)->SetObjectArrayElement(env, said, 2, times);
}

/* Numbers of the event: type, state, code, is_final, media_time, sequence, duration; texts: where, message; said: of
 * TEXT, see set_said(). False: none. */
NATIVE(jboolean, streamNextEvent)
(JNIEnv* env, jclass type, jlong stream, jdoubleArray numbers, jobjectArray texts, jobjectArray said) {
  (void)type;
  semblante_event event;
  memset(&event, 0, sizeof event);
  event.size = sizeof event;
  if (semblante_stream_next_event(HANDLE(semblante_stream, stream), &event) == 0) return JNI_FALSE;
  const double values[7] = {
      event.type, event.state, event.code, event.is_final, event.media_time, (double)event.sequence, event.duration};
  (*env)->SetDoubleArrayRegion(env, numbers, 0, 7, values);
  if (event.type == SEMBLANTE_EVENT_TEXT) set_said(env, said, &event);
  (*env)->SetObjectArrayElement(env, texts, 0, text_of(env, event.error.where));
  (*env)->SetObjectArrayElement(env, texts, 1, text_of(env, event.error.message));
  return JNI_TRUE;
}

NATIVE(void, streamSetCaptions)(JNIEnv* env, jclass type, jlong stream, jboolean on) {
  (void)type;
  check(env, semblante_stream_set_captions(HANDLE(semblante_stream, stream), on != JNI_FALSE));
}

NATIVE(jint, streamFrameCount)(JNIEnv* env, jclass type, jlong stream) {
  (void)env, (void)type;
  uint32_t count = 0;
  semblante_stream_frames(HANDLE(semblante_stream, stream), &count);
  return (jint)count;
}

/* The time of frame `index`, and its numbers. */
NATIVE(jdouble, streamFrame)(JNIEnv* env, jclass type, jlong stream, jint index, jfloatArray numbers) {
  (void)type;
  uint32_t count = 0;
  const semblante_timed_frame* frames = semblante_stream_frames(HANDLE(semblante_stream, stream), &count);
  if (index < 0 || (uint32_t)index >= count) {
    check(env, SEMBLANTE_INVALID_ARGUMENT);
    return 0;
  }
  put_frame(env, &frames[index].frame, numbers);
  return frames[index].time;
}

NATIVE(void, streamPublish)
(JNIEnv* env, jclass type, jlong stream, jdoubleArray times, jobjectArray faces, jdouble mediaTime, jdouble now) {
  (void)type;
  const jsize count = (*env)->GetArrayLength(env, times);
  semblante_timed_frame* frames = calloc((size_t)count + 1, sizeof *frames);
  if (frames == NULL) {
    check(env, SEMBLANTE_OUT_OF_MEMORY);
    return;
  }
  for (jsize i = 0; i < count && !(*env)->ExceptionCheck(env); ++i) {
    float values[FRAME] = {0};
    jfloatArray face = (*env)->GetObjectArrayElement(env, faces, i);
    if (face == NULL) break;
    (*env)->GetFloatArrayRegion(env, face, 0, FRAME, values);
    (*env)->GetDoubleArrayRegion(env, times, i, 1, &frames[i].time);
    (*env)->DeleteLocalRef(env, face);
    frames[i].frame = frame_of(values);
  }
  if (!(*env)->ExceptionCheck(env))
    check(env, semblante_stream_publish(HANDLE(semblante_stream, stream), frames, (uint32_t)count, mediaTime, now));
  free(frames);
}

NATIVE(void, streamPublishSound)(JNIEnv* env, jclass type, jlong stream, jbyteArray packet, jdouble mediaTime) {
  (void)type;
  const jsize size = (*env)->GetArrayLength(env, packet);
  jbyte* bytes = (*env)->GetByteArrayElements(env, packet, NULL);
  if (bytes == NULL) {
    check(env, SEMBLANTE_OUT_OF_MEMORY);
    return;
  }
  const semblante_result result = semblante_stream_publish_sound(HANDLE(semblante_stream, stream),
                                                                 (const uint8_t*)bytes, (uint32_t)size, mediaTime);
  (*env)->ReleaseByteArrayElements(env, packet, bytes, JNI_ABORT);
  check(env, result);
}

/* ---- players */

NATIVE(jlong, playerCreate)(JNIEnv* env, jclass type, jdouble delay, jboolean eased) {
  (void)type;
  semblante_player_options options;
  semblante_error error;
  semblante_player* player = NULL;
  memset(&options, 0, sizeof options);
  memset(&error, 0, sizeof error);
  options.size = sizeof options;
  options.delay = delay;
  options.eased = eased != JNI_FALSE;
  const semblante_result result = semblante_player_create(&options, &player, &error);
  if (result != SEMBLANTE_OK) throw_failure(env, result, &error);
  return (jlong)(intptr_t)player;
}

NATIVE(void, playerDestroy)(JNIEnv* env, jclass type, jlong player) {
  (void)env, (void)type;
  semblante_player_destroy(HANDLE(semblante_player, player));
}

NATIVE(void, playerFollow)(JNIEnv* env, jclass type, jlong player, jlong stream) {
  (void)type;
  check(env, semblante_player_follow(HANDLE(semblante_player, player), HANDLE(semblante_stream, stream)));
}

NATIVE(jboolean, playerAdvance)(JNIEnv* env, jclass type, jlong player, jdouble now, jdouble elapsed) {
  (void)env, (void)type;
  return semblante_player_advance(HANDLE(semblante_player, player), now, elapsed) != 0;
}

NATIVE(jboolean, playerShow)(JNIEnv* env, jclass type, jlong player, jlong head) {
  (void)env, (void)type;
  return semblante_player_show(HANDLE(semblante_player, player), HANDLE(semblante_head, head)) != 0;
}

NATIVE(jdouble, playerTime)(JNIEnv* env, jclass type, jlong player) {
  (void)env, (void)type;
  return semblante_player_time(HANDLE(semblante_player, player));
}

/* ---- performances and bridges */

NATIVE(jlong, performanceCreate)(JNIEnv* env, jclass type, jbyteArray json) {
  (void)type;
  jbyte* bytes = (*env)->GetByteArrayElements(env, json, NULL);
  if (bytes == NULL) return 0;
  semblante_error error;
  semblante_performance* performance = NULL;
  memset(&error, 0, sizeof error);
  const semblante_result result =
      semblante_performance_create((const char*)bytes, (size_t)(*env)->GetArrayLength(env, json), &performance, &error);
  (*env)->ReleaseByteArrayElements(env, json, bytes, JNI_ABORT);
  if (result != SEMBLANTE_OK) throw_failure(env, result, &error);
  return (jlong)(intptr_t)performance;
}

NATIVE(void, performanceDestroy)(JNIEnv* env, jclass type, jlong performance) {
  (void)env, (void)type;
  semblante_performance_destroy(HANDLE(semblante_performance, performance));
}

NATIVE(jdouble, performanceDuration)(JNIEnv* env, jclass type, jlong performance) {
  (void)env, (void)type;
  return semblante_performance_duration(HANDLE(semblante_performance, performance));
}

NATIVE(void, performanceFrameAt)(JNIEnv* env, jclass type, jlong performance, jdouble ms, jfloatArray numbers) {
  (void)type;
  semblante_frame frame;
  const semblante_result result =
      semblante_performance_frame_at(HANDLE(semblante_performance, performance), ms, ms, &frame);
  if (result != SEMBLANTE_OK)
    check(env, result);
  else
    put_frame(env, &frame, numbers);
}

NATIVE(void, frameFromArkit)(JNIEnv* env, jclass type, jfloatArray coefficients, jfloatArray numbers) {
  (void)type;
  float values[52];
  (*env)->GetFloatArrayRegion(env, coefficients, 0, 52, values);
  if ((*env)->ExceptionCheck(env)) return;
  semblante_frame frame;
  semblante_error error;
  memset(&error, 0, sizeof error);
  const semblante_result result = semblante_frame_from_arkit(values, &frame, &error);
  if (result != SEMBLANTE_OK)
    throw_failure(env, result, &error);
  else
    put_frame(env, &frame, numbers);
}

NATIVE(void, arkitFromFrame)(JNIEnv* env, jclass type, jfloatArray numbers, jfloatArray coefficients) {
  (void)type;
  float values[FRAME];
  float shapes[52];
  (*env)->GetFloatArrayRegion(env, numbers, 0, FRAME, values);
  if ((*env)->ExceptionCheck(env)) return;
  const semblante_frame frame = frame_of(values);
  const semblante_result result = semblante_arkit_from_frame(&frame, shapes);
  if (result != SEMBLANTE_OK)
    check(env, result);
  else
    (*env)->SetFloatArrayRegion(env, coefficients, 0, 52, shapes);
}

NATIVE(jstring, arkitName)(JNIEnv* env, jclass type, jint shape) {
  (void)type;
  const char* name = semblante_arkit_name((uint32_t)shape);
  return name == NULL ? NULL : (*env)->NewStringUTF(env, name);
}

/* ---- listeners */

NATIVE(jlong, listenerCreate)(JNIEnv* env, jclass type, jint sampleRate) {
  (void)type;
  semblante_listener_options options = {sizeof options, sampleRate < 0 ? 0 : (uint32_t)sampleRate};
  semblante_error error;
  semblante_listener* listener = NULL;
  memset(&error, 0, sizeof error);
  const semblante_result result = semblante_listener_create(&options, &listener, &error);
  if (result != SEMBLANTE_OK) throw_failure(env, result, &error);
  return (jlong)(intptr_t)listener;
}

NATIVE(void, listenerDestroy)(JNIEnv* env, jclass type, jlong listener) {
  (void)env, (void)type;
  semblante_listener_destroy(HANDLE(semblante_listener, listener));
}

NATIVE(jboolean, listenerPush)(JNIEnv* env, jclass type, jlong listener, jfloatArray samples, jfloatArray numbers) {
  (void)type;
  jfloat* all = (*env)->GetFloatArrayElements(env, samples, NULL);
  if (all == NULL) return JNI_FALSE;
  const uint32_t count = (uint32_t)(*env)->GetArrayLength(env, samples);
  semblante_heard newest;
  semblante_heard heard;
  memset(&heard, 0, sizeof heard);
  heard.size = sizeof heard;
  newest = heard;
  jboolean found = JNI_FALSE;
  semblante_result result = SEMBLANTE_OK;
  for (uint32_t at = 0, taken = 0; result == SEMBLANTE_OK; at += taken) {
    result = semblante_listener_push(HANDLE(semblante_listener, listener), all + at, count - at, &taken, &heard);
    if (result != SEMBLANTE_OK) continue;
    newest = heard;
    found = JNI_TRUE;
  }
  (*env)->ReleaseFloatArrayElements(env, samples, all, JNI_ABORT);
  if (result != SEMBLANTE_UNAVAILABLE) {
    check(env, result);
    return JNI_FALSE;
  }
  if (!found) return JNI_FALSE;
  semblante_frame frame;
  semblante_error error;
  memset(&error, 0, sizeof error);
  result = semblante_frame_from_oculus(newest.weights, &frame, &error);
  if (result != SEMBLANTE_OK)
    throw_failure(env, result, &error);
  else
    put_frame(env, &frame, numbers);
  return found;
}
