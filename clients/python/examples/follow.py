"""Follows a stream and prints how far the jaw is open: follow.py http://127.0.0.1:8080 demo [MODEL] [FRAMES]"""

import sys

import semblante

server, stream = sys.argv[1:3]
model = sys.argv[3] if len(sys.argv) > 3 else "sample"
frames = int(sys.argv[4]) if len(sys.argv) > 4 else 0
head = semblante.fetch_head(server, model)
jaw = 0  # the index of FP 2.1
for count, player in enumerate(semblante.follow(server, stream, head=head, rate=30), 1):
    print(f"{player.time:10.1f} ms  jaw {-head.pose.fp[3 * jaw + 1]:8.4f}", flush=True)
    if count == frames:
        break
