#!/usr/bin/env python3
"""Trains the network of the listener and writes its weights: README.md.

    train.py FEATURES_PROGRAM CORPUS [--write WEIGHTS] [--epochs N] [--hidden N]

Recurrent units of Cho et al. 2014 with the reset gate after the product, by Adam (Kingma and Ba 2014) on truncated sequences. Then the
weights are rounded to 8 bits, a scale for each row, and every set of CORPUS that was held out is measured with them.
"""
import argparse
import glob
import os
import subprocess
import sys

os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')
import numpy as np

BANDS, FEATURES, STACKED, LOOK_AHEAD, VISEMES = 24, 25, 3, 4, 15
CLOSED, CLOSED_BONUS = 1, 0.5  # a missing closure of the lips is seen more than one too many: that much is added to its logarithm
NAMES = 'sil pbm fv th td kg chjsh sz nl r a e i o u'.split()


def read_set(program, folder):
    """Features and visemes of each file of a set; computed once."""
    path = folder + '.features'
    if not os.path.exists(path):
        subprocess.run([program, path] + sorted(glob.glob(folder + '/*.wav')), check=True)
    data = open(path, 'rb').read()
    at, files = 0, []
    while at < len(data):
        count = int(np.frombuffer(data, np.int32, 1, at)[0])
        features = np.frombuffer(data, np.float32, count * FEATURES, at + 4).reshape(count, FEATURES)
        at += 4 + 4 * count * FEATURES
        files.append((features, np.frombuffer(data, np.int8, count, at)))
        at += count
    return files


def stacked(features):
    """Frames t-2, t-1, t side by side: T x 75; before the sound is 0."""
    padded = np.concatenate([np.zeros((STACKED - 1, FEATURES), np.float32), features])
    return np.concatenate([padded[i:i + len(features)] for i in range(STACKED)], 1)


def sigmoid(x):
    return 1 / (1 + np.exp(-x))


class Network:
    """x -> relu(x A + a) -> recurrent units -> B h + b; the rows of a matrix are its outputs when it is written."""

    def __init__(self, hidden, rng):
        inputs = FEATURES * STACKED
        uniform = lambda rows, columns, gain=1.0: (rng.standard_normal((rows, columns)) * gain / np.sqrt(rows)).astype(np.float32)
        self.hidden = hidden
        self.p = {
            'A': uniform(inputs, hidden, 1.4), 'a': np.zeros(hidden, np.float32),
            'W': uniform(hidden, 3 * hidden), 'w': np.zeros(3 * hidden, np.float32),
            'U': uniform(hidden, 3 * hidden), 'u': np.zeros(hidden, np.float32),
            'B': uniform(hidden, VISEMES), 'b': np.zeros(VISEMES, np.float32),
        }

    def forward(self, x, first, h, keep=None):
        """x: T x S x inputs; first: T x S, 1 where a file begins; h: S x hidden. Logits, T x S x visemes."""
        p, n = self.p, self.hidden
        steps, streams, _ = x.shape
        dense = np.maximum(x.reshape(steps * streams, -1) @ p['A'] + p['a'], 0)
        if keep is not None:
            dense *= keep
        gx = (dense @ p['W'] + p['w']).reshape(steps, streams, 3 * n)
        tape, states = [], np.empty((steps, streams, n), np.float32)
        for t in range(steps):
            before = h * (1 - first[t])[:, None]
            gh = before @ p['U']
            gates = sigmoid(gx[t][:, :2 * n] + gh[:, :2 * n])
            r, z = gates[:, :n], gates[:, n:]
            inner = gh[:, 2 * n:] + p['u']
            candidate = np.tanh(gx[t][:, 2 * n:] + r * inner)
            h = candidate + z * (before - candidate)
            states[t] = h
            tape.append((before, r, z, inner, candidate))
        return states.reshape(-1, n) @ p['B'] + p['b'], (x, dense, keep, tape, states), h

    def backward(self, d_logits, record, first):
        p, n = self.p, self.hidden
        x, dense, keep, tape, states = record
        steps, streams, _ = x.shape
        g = {'B': states.reshape(-1, n).T @ d_logits, 'b': d_logits.sum(0)}
        d_states = (d_logits @ p['B'].T).reshape(steps, streams, n)
        d_gx, d_gh = np.empty((steps, streams, 3 * n), np.float32), np.empty((steps, streams, 3 * n), np.float32)
        d_h = np.zeros((streams, n), np.float32)
        for t in reversed(range(steps)):
            before, r, z, inner, candidate = tape[t]
            d = d_states[t] + d_h
            d_candidate = d * (1 - z) * (1 - candidate ** 2)
            d_z = d * (before - candidate) * z * (1 - z)
            d_r = d_candidate * inner * r * (1 - r)
            d_gx[t, :, :n], d_gx[t, :, n:2 * n], d_gx[t, :, 2 * n:] = d_r, d_z, d_candidate
            d_gh[t] = d_gx[t]
            d_gh[t, :, 2 * n:] = d_candidate * r
            d_h = (d * z + d_gh[t] @ p['U'].T) * (1 - first[t])[:, None]
        befores = np.stack([one[0] for one in tape]).reshape(-1, n)
        flat_x, flat_h = d_gx.reshape(-1, 3 * n), d_gh.reshape(-1, 3 * n)
        g['U'], g['u'] = befores.T @ flat_h, flat_h[:, 2 * n:].sum(0)
        g['W'], g['w'] = dense.T @ flat_x, flat_x.sum(0)
        d_dense = flat_x @ p['W'].T
        if keep is not None:
            d_dense *= keep
        d_dense *= dense > 0
        g['A'], g['a'] = x.reshape(steps * streams, -1).T @ d_dense, d_dense.sum(0)
        return g

    def rounded(self):
        """The same with 8 bits for each weight."""
        copy = Network.__new__(Network)
        copy.hidden, copy.p = self.hidden, dict(self.p)
        for name in 'AWUB':
            scale = np.abs(self.p[name]).max(0) / 127
            copy.p[name] = (np.rint(self.p[name] / scale) * scale).astype(np.float32)
        return copy


def streams_of(files, count, rng):
    """All files, in a random order, one behind the other in `count` streams: features, visemes of LOOK_AHEAD frames earlier, begins."""
    order = rng.permutation(len(files))
    features, visemes, first = [], [], []
    for i in order:
        one, said = files[i]
        one = one + rng.standard_normal((1, FEATURES)).astype(np.float32) * 0.08  # another colour
        one = one + rng.standard_normal(one.shape).astype(np.float32) * 0.05
        if rng.random() < 0.3:
            band, wide = rng.integers(BANDS), rng.integers(1, 4)
            one[:, band:min(band + wide, BANDS)] = rng.uniform(-1.5, 0.5)
        features.append(stacked(one))
        visemes.append(np.concatenate([np.full(LOOK_AHEAD, -1, np.int8), said[:-LOOK_AHEAD]]))
        begins = np.zeros(len(said), np.float32)
        begins[0] = 1
        first.append(begins)
    steps = sum(map(len, visemes)) // count
    cut = lambda parts: np.concatenate(parts)[:steps * count]
    return (cut(features).reshape(count, steps, -1), cut(visemes).reshape(count, steps), cut(first).reshape(count, steps))


def measure(network, files):
    """Confusion: said x heard, in frames."""
    confusion = np.zeros((VISEMES, VISEMES), np.int64)
    longest = max(len(said) for _, said in files)
    x = np.zeros((longest, len(files), FEATURES * STACKED), np.float32)
    said = np.full((longest, len(files)), -1, np.int8)
    for i, (features, visemes) in enumerate(files):
        x[:len(features), i] = stacked(features)
        said[LOOK_AHEAD:len(visemes), i] = visemes[:-LOOK_AHEAD]
    first = np.zeros(said.shape, np.float32)
    logits, _, _ = network.forward(x, first, np.zeros((len(files), network.hidden), np.float32))
    heard = logits.argmax(1).reshape(said.shape)
    known = said >= 0
    np.add.at(confusion, (said[known], heard[known]), 1)
    return confusion


def right(confusion):
    """% of all frames, and of those of speech."""
    return 100 * np.trace(confusion) / confusion.sum(), 100 * np.trace(confusion[1:, 1:]) / confusion[1:].sum()


def train(network, files, epochs, rng, held):
    p = network.p
    mean, square = {k: np.zeros_like(v) for k, v in p.items()}, {k: np.zeros_like(v) for k, v in p.items()}
    count, length, step = 96, 96, 0
    total = None
    for epoch in range(epochs):
        x, said, first = streams_of(files, count, rng)
        h = np.zeros((count, network.hidden), np.float32)
        loss = frames = 0
        parts = x.shape[1] // length
        total = total or parts * epochs
        for part in range(parts):
            at = slice(part * length, (part + 1) * length)
            xs, ys = x[:, at].transpose(1, 0, 2), said[:, at].T.reshape(-1)
            fs = np.ascontiguousarray(first[:, at].T)
            keep = ((rng.random((length * count, network.hidden), np.float32) < 0.9) / 0.9).astype(np.float32)
            logits, record, h = network.forward(np.ascontiguousarray(xs), fs, h, keep)
            logits -= logits.max(1, keepdims=True)
            likely = np.exp(logits)
            likely /= likely.sum(1, keepdims=True)
            known = ys >= 0
            rows = np.nonzero(known)[0]
            loss -= np.log(likely[rows, ys[rows]] + 1e-9).sum()
            frames += len(rows)
            likely[rows, ys[rows]] -= 1
            likely[~known] = 0
            gradient = network.backward(likely / max(1, len(rows)), record, fs)
            norm = np.sqrt(sum(float((g ** 2).sum()) for g in gradient.values()))
            step += 1
            rate = 4e-3 * min(1, step / 100) * (0.5 + 0.5 * np.cos(np.pi * min(1, step / total))) + 2e-5
            for k, g in gradient.items():
                g = g * min(1, 1 / norm)
                mean[k] += 0.1 * (g - mean[k])
                square[k] += 0.002 * (g * g - square[k])
                p[k] -= (rate * (mean[k] / (1 - 0.9 ** step)) / (np.sqrt(square[k] / (1 - 0.998 ** step)) + 1e-8)).astype(np.float32)
        print(f'epoch {epoch + 1}: loss {loss / frames:.3f}', ' '.join(f'{name} {right(measure(network, files))[0]:.1f}' for name, files in held.items()), flush=True)


def text_of(network, provenance):
    """The weights as C++: of each output a row."""
    lines = ['// Generated by core/listen/train/train.py; do not edit.', f'// {provenance}']
    wrapped = lambda values: [', '.join(values[i:i + 24]) + ',' for i in range(0, len(values), 24)]
    for name, label in (('A', 'dense'), ('W', 'input'), ('U', 'state'), ('B', 'output')):
        rows = network.p[name].T
        scale = np.abs(rows).max(1) / 127
        lines.append(f'constexpr std::int8_t {label}_weights[] = {{')
        lines += wrapped([str(int(v)) for v in np.rint(rows / scale[:, None]).reshape(-1)])
        lines += ['};', f'constexpr float {label}_scales[] = {{'] + wrapped([f'{v:.6g}F' if 'e' in f'{v:.6g}' or '.' in f'{v:.6g}' else f'{v:.6g}.0F' for v in scale]) + ['};']
    for name, label in (('a', 'dense'), ('w', 'input'), ('u', 'state'), ('b', 'output')):
        lines += [f'constexpr float {label}_biases[] = {{'] + wrapped([f'{v:.6f}F' for v in network.p[name]]) + ['};']
    return '\n'.join(lines) + '\n'


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('corpus')
    parser.add_argument('--write')
    parser.add_argument('--epochs', type=int, default=12)
    parser.add_argument('--hidden', type=int, default=64)
    parser.add_argument('--skip', default='')
    options = parser.parse_args()
    rng = np.random.default_rng(11)
    sets = {os.path.basename(path): read_set(options.program, path) for path in sorted(glob.glob(options.corpus + '/*')) if os.path.isdir(path)}
    files = sets.pop('train')
    print('trained on', round(sum(len(said) for _, said in files) / 6000), 'minutes')
    network = Network(options.hidden, rng)
    train(network, files, options.epochs, rng, sets)
    network.p['b'][CLOSED] += CLOSED_BONUS
    whole, network = network, network.rounded()
    for name, files in sets.items():
        confusion = measure(network, files)
        print(f'{name}: {right(confusion)[0]:.1f} % of frames, {right(confusion)[1]:.1f} % of speech; before rounding {right(measure(whole, files))[0]:.1f}')
        shares = 100 * confusion / np.maximum(1, confusion.sum(1, keepdims=True))
        print('        ' + ' '.join(f'{n:>5}' for n in NAMES))
        for n, row in zip(NAMES, shares):
            print(f'{n:>7} ' + ' '.join(f'{v:5.0f}' for v in row))
    if options.write:
        minutes = round(sum(len(said) for _, said in read_set(options.program, options.corpus + '/train')) / 6000)
        with open(options.write, 'w', encoding='utf-8') as file:
            file.write(text_of(network, f'{options.hidden} units, {options.epochs} epochs of {minutes} minutes of synthetic speech: train/README.md.'))


if __name__ == '__main__':
    sys.exit(main())
