/* Follows a stream on the face of a package and prints how far the jaw is open:
 *
 *   follow HOST PORT STREAM FOLDER [FRAMES]       (follow 127.0.0.1 8080 demo package/)
 *
 * The library has the protocol, the clock and the playout; here are a POSIX socket and as much WebSocket (RFC 6455) as
 * a client needs. A program with a WebSocket of its own keeps only main(). Without TLS.
 *
 *   cc follow.c $(pkg-config --cflags --libs semblante) -o follow */
#define _POSIX_C_SOURCE 200809L
#include <netdb.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <sys/socket.h>
#include <sys/time.h>

#include "package_files.h"

#define FRAME_TIME 33.3             /* ms between two shown faces */
#define LONGEST (262144 + 14)       /* bytes of a message, with its WebSocket header */
static unsigned char held[LONGEST]; /* received, not yet a whole message */
static size_t held_size;

static double now_ms(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec * 1e3 + (double)t.tv_nsec / 1e6;
}

static int send_all(int fd, const void* bytes, size_t size) {
  const char* at = (const char*)bytes;
  while (size > 0) {
    const ssize_t sent = send(fd, at, size, MSG_NOSIGNAL);
    if (sent <= 0) return 0;
    at += sent;
    size -= (size_t)sent;
  }
  return 1;
}

static int receive_some(int fd) {
  const ssize_t got = recv(fd, held + held_size, sizeof(held) - held_size, 0);
  if (got > 0) held_size += (size_t)got;
  return got > 0;
}

static void drop(size_t size) {
  held_size -= size;
  memmove(held, held + size, held_size);
}

/* One message of a client: its bytes are masked. */
static int send_message(int fd, unsigned kind, const uint8_t* bytes, size_t size) {
  static unsigned char out[LONGEST];
  size_t at = 2, i;
  unsigned char* mask;
  FILE* random = fopen("/dev/urandom", "rb");
  if (random == NULL || size > 262144) return 0;
  out[0] = (unsigned char)(0x80 | kind);
  if (size < 126) {
    out[1] = (unsigned char)(0x80 | size);
  } else {
    out[1] = 0x80 | 127;
    for (i = 0; i < 8; ++i) out[at++] = (unsigned char)((uint64_t)size >> (56 - 8 * i));
  }
  mask = out + at;
  i = fread(mask, 1, 4, random);
  fclose(random);
  if (i != 4) return 0;
  at += 4;
  for (i = 0; i < size; ++i) out[at + i] = (unsigned char)(bytes[i] ^ mask[i % 4]);
  return send_all(fd, out, at + size);
}

/* open_socket: the server's answer does not change by asking again, such as 404 for a stream that it does not have. */
#define REFUSED (-2)

/* Socket and handshake; -1 when it fails, or REFUSED. A browser's key and its proof guard against caches, which are not
 * here. */
static int open_socket(const char* host, const char* port, const char* stream) {
  struct addrinfo hints, *found = NULL, *at;
  struct timeval patience = {10, 0};
  char text[1024];
  int fd = -1, line;
  memset(&hints, 0, sizeof(hints));
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host, port, &hints, &found) != 0) return -1;
  for (at = found; at != NULL && fd < 0; at = at->ai_next) {
    fd = socket(at->ai_family, at->ai_socktype, at->ai_protocol);
    if (fd >= 0 && connect(fd, at->ai_addr, at->ai_addrlen) != 0) close(fd), fd = -1;
  }
  freeaddrinfo(found);
  if (fd < 0) return -1;
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  snprintf(text, sizeof(text),
           "GET /v1/streams/%s HTTP/1.1\r\nHost: %s:%s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: c2VtYmxhbnRlIGZvbGxvdw==\r\n"
           "Sec-WebSocket-Protocol: " SEMBLANTE_SUBPROTOCOL "\r\n\r\n",
           stream, host, port);
  held_size = 0;
  if (send_all(fd, text, strlen(text))) {
    while (held_size < 16384 && receive_some(fd)) {
      size_t end;
      for (end = 4; end <= held_size && memcmp(held + end - 4, "\r\n\r\n", 4) != 0;) ++end;
      if (end > held_size) continue;
      if (memcmp(held, "HTTP/1.1 101 ", 13) != 0) break;
      drop(end);
      return fd;
    }
  }
  close(fd);
  for (line = 0; line < 80 && (size_t)line < held_size && held[line] != '\r'; ++line) continue;
  fprintf(stderr, "the server does not open the stream: %.*s\n", line, (const char*)held);
  if (held_size < 12 || memcmp(held, "HTTP/1.1 4", 10) != 0 || memcmp(held + 9, "429", 3) == 0) return -1;
  return REFUSED;
}

/* Hands whole messages to the stream; 0 when the connection is to be given up, and then the server's close code, if
 * any. */
static int take_messages(int fd, semblante_stream* stream, double now, uint32_t* code) {
  while (held_size >= 2) {
    uint64_t size = held[1] & 127;
    size_t at = 2, i, bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
    const unsigned kind = held[0] & 15;
    if (held_size < at + bytes) return 1;
    for (i = 0, size = bytes > 0 ? 0 : size; i < bytes; ++i) size = size << 8 | held[at++];
    if (size > LONGEST - 14 || (held[0] & 0x80) == 0) return 0; /* the server's messages are whole and short */
    if (held_size < at + size) return 1;
    if (kind == 2) semblante_stream_receive(stream, held + at, (size_t)size, now);
    if (kind == 8) {
      if (size >= 2) *code = (uint32_t)held[at] << 8 | held[at + 1];
      return 0;
    }
    if (kind == 9 && !send_message(fd, 10, held + at, (size_t)size)) return 0;
    drop(at + (size_t)size);
  }
  return 1;
}

int main(int argc, char** argv) {
  semblante_stream* stream = NULL;
  semblante_player* player = NULL;
  semblante_head* head;
  semblante_error error;
  double shown = now_ms();
  int fd = -1, is_over = 0, is_refused = 0;
  long frames;
  if (argc < 5) {
    fprintf(stderr, "usage: %s HOST PORT STREAM FOLDER [FRAMES]\n", argv[0]);
    return 2;
  }
  frames = argc > 5 ? atol(argv[5]) : -1;
  head = read_head(argv[4]);
  if (head == NULL) return 1;
  if (semblante_stream_create(NULL, &stream, &error) != SEMBLANTE_OK ||
      semblante_player_create(NULL, &player, &error) != SEMBLANTE_OK ||
      semblante_player_follow(player, stream) != SEMBLANTE_OK) {
    fprintf(stderr, "out of memory\n");
    return 1;
  }
  semblante_stream_start(stream, shown);
  while (!is_over && frames != 0) {
    semblante_event event;
    const uint8_t* bytes;
    size_t size;
    double now = now_ms(), due;
    event.size = sizeof(event);
    while (semblante_stream_next_event(stream, &event)) {
      if (event.type == SEMBLANTE_EVENT_CONNECT) {
        fd = open_socket(argv[1], argv[2], argv[3]);
        if (fd == REFUSED) is_over = is_refused = 1;
        if (fd < 0)
          semblante_stream_closed(stream, 0, now_ms());
        else
          semblante_stream_opened(stream, now_ms());
      } else if (event.type == SEMBLANTE_EVENT_CLOSE) {
        if (fd >= 0) close(fd);
        fd = -1;
      } else if (event.type == SEMBLANTE_EVENT_REFUSED || event.type == SEMBLANTE_EVENT_FAULT) {
        fprintf(stderr, "%s\n", event.error.message);
      } else if (event.type == SEMBLANTE_EVENT_END && event.is_final) {
        is_over = 1;
      }
    }
    while (fd >= 0 && (bytes = semblante_stream_take_bytes(stream, &size)) != NULL) {
      if (!send_message(fd, 2, bytes, size)) break; /* recv() tells that the connection is lost */
    }

    /* Sleep until the socket has something, the stream wants a turn, or the next face is due. */
    due = semblante_stream_wake_time(stream);
    if (due > shown + FRAME_TIME) due = shown + FRAME_TIME;
    now = now_ms();
    if (fd >= 0) {
      struct pollfd wait;
      uint32_t code = 0;
      wait.fd = fd;
      wait.events = POLLIN;
      if (poll(&wait, 1, due > now ? (int)(due - now) + 1 : 0) > 0 &&
          (!receive_some(fd) || !take_messages(fd, stream, now_ms(), &code))) {
        close(fd);
        fd = -1;
        semblante_stream_closed(stream, code, now_ms());
      }
    } else {
      poll(NULL, 0, due > now ? (int)(due - now) + 1 : 0);
    }
    now = now_ms();
    semblante_stream_tick(stream, now);

    if (now >= shown + FRAME_TIME) {
      if (semblante_player_advance(player, now, now - shown) && semblante_player_show(player, head)) {
        const semblante_pose* pose = semblante_head_pose(head);
        printf("%10.1f ms  jaw %8.4f\n", semblante_player_time(player), 0.0 - (double)pose->fp[1]); /* y of point 2.1 */
        fflush(stdout);
        if (frames > 0) --frames;
      }
      shown = now;
    }
  }
  if (fd >= 0) close(fd);
  semblante_player_destroy(player);
  semblante_stream_destroy(stream);
  semblante_head_destroy(head);
  return is_refused;
}
