#!/usr/bin/env python3
"""Speech of synthesizers with the times of its phonemes, to train and to measure the listener: README.md.

    corpus.py VOICE_ESPEAK FOLDER [MINUTES]

Writes FOLDER/SET/NAME.wav and NAME.txt, a label track of begin, end (s) and IPA; SET is `train` or what was held out. MINUTES is the
length of the training set. The texts are those of Debian's fortunes, fortunes-br and fortunes-it.
"""
import base64
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import wave

import numpy as np

from cmu import CMU

ITALIAN = {
    'a': 'a', 'e': 'e', 'E': 'ɛ', 'i': 'i', 'o': 'o', 'O': 'ɔ', 'u': 'u', 'p': 'p', 'b': 'b', 't': 't', 'd': 'd', 'k': 'k', 'g': 'ɡ',
    'f': 'f', 'v': 'v', 's': 's', 'z': 'z', 'ts': 's', 'dz': 'z', 'tS': 'tʃ', 'dZ': 'dʒ', 'S': 'ʃ', 'm': 'm', 'n': 'n', 'ng': 'ŋ',
    'nf': 'n', 'J': 'n', 'JJ': 'n', 'l': 'l', 'L': 'l', 'LL': 'l', 'r': 'ɾ', 'j': 'j', 'w': 'w', 'tts': 's', 'ddz': 'z', 'ttS': 'tʃ',
    'ddZ': 'dʒ', 'SS': 'ʃ',
}
FINNISH = {
    'a': 'ɑ', 'e': 'e', 'i': 'i', 'o': 'o', 'u': 'u', '@': 'æ', 'p': 'p', 'b': 'b', 't': 't', 'd': 'd', 'k': 'k', 'g': 'ɡ', 'N': 'ŋ',
    'f': 'f', 'v': 'v', 's': 's', 'h': 'h', 'm': 'm', 'n': 'n', 'l': 'l', 'r': 'ɾ', 'j': 'j',
}
SILENT = {'pau', '#', 'h#', 'brth', '_', '', 'ssil', 'sil'}
FINNISH_TEXT = """Kaikki ihmiset syntyvät vapaina ja tasavertaisina arvoltaan ja oikeuksiltaan.
Minä menen huomenna kauppaan ja ostan maitoa, leipää ja voita.
Pieni poika pallo kainalossa pomppi pihalla koko päivän.
Tule tänne, sanoi isoäiti ja avasi ikkunan.
Talvella järvi jäätyy ja lapset luistelevat illalla.
Viisi vanhaa varista lensi vuoren yli.
Missä sinä olit eilen, kun me soitimme sinulle?
Juna lähtee asemalta kello seitsemän ja saapuu illalla.
Kesällä aurinko paistaa melkein koko yön.
Hän kertoi minulle pitkän tarinan merestä ja saarista.
Bussi ajoi sillan yli ja pysähtyi torin reunalle.
Lumi suli maaliskuussa, ja puro alkoi virrata metsän läpi.""".split('\n')


def sentences(language):
    """Sentences of at most twenty words, letters and marks alone."""
    files = {'en': 'literature people wisdom science', 'pt': 'brasil', 'it': 'italia'}[language].split()
    found = []
    for name in files:
        with open('/usr/share/games/fortunes/' + name, 'rb') as file:
            data = file.read()
        try:
            text = data.decode()
        except UnicodeDecodeError:
            text = data.decode('latin-1')
        for entry in text.split('\n%'):
            entry = re.sub(r'\s*--.*', '', entry, flags=re.S).replace("e'", 'è') if language == 'it' else re.sub(r'\s*--.*', '', entry, flags=re.S)
            for one in re.split(r'(?<=[.!?;:])\s+', re.sub(r'\s+', ' ', entry)):
                if 20 <= len(one) <= 110 and re.fullmatch(r"[A-Za-zÀ-ÿ ,.!?;:'’-]+", one):
                    found.append(one)
    return found


def read_wave(path):
    with wave.open(path, 'rb') as file:
        return file.getframerate(), np.frombuffer(file.readframes(file.getnframes()), np.int16).astype(np.float32) / 32768


def espeak(program, text, language, voice, rate, pitch):
    """Rate, samples, and (begin, end, IPA) in s."""
    request = {'protocol': 1, 'text': text, 'ssml': False, 'language': language, 'voice': voice, 'rate': rate, 'pitch': pitch}
    answer = subprocess.run([program], input=json.dumps(request).encode(), capture_output=True, check=False)
    times, audio, sample_rate = [], [], 0
    for line in answer.stdout.splitlines():
        event = json.loads(line)
        if 'error' in event:
            raise RuntimeError(f'{voice}: {event["error"]}')
        sample_rate = event.get('sample_rate', sample_rate)
        if 'audio' in event:
            audio.append(np.frombuffer(base64.b64decode(event['audio']), np.int16))
        if 'phoneme' in event:
            times.append((event['time'] / 1000, event['phoneme']))
    sound = np.concatenate(audio).astype(np.float32) / 32768
    ends = [time for time, _ in times[1:]] + [len(sound) / sample_rate]
    return sample_rate, sound, [(begin, end, ipa) for (begin, ipa), end in zip(times, ends)]


def labels_of(ends, phones, names):
    labels, begin = [], 0.0
    for end, phone in zip(ends, phones):
        name = re.sub(r'[0-9:]+$', '', phone)
        if name in SILENT:
            ipa = ''
        elif name in names:
            ipa = names[name]
        else:
            ipa = '?'  # a sound without a row: not learnt from
        labels.append((begin, end, ipa))
        begin = end
    return labels


def flite(text, voice, folder):
    path = os.path.join(folder, 'flite.wav')
    told = subprocess.run(['flite', '-voice', voice, '-psdur', '-t', text, '-o', path], capture_output=True, check=True)
    pairs = [one.rsplit(':', 1) for one in told.stdout.decode().split()]
    rate, sound = read_wave(path)
    return rate, sound, labels_of([float(end) for _, end in pairs], [phone for phone, _ in pairs], CMU)


def festival(texts, voice, names, folder, encoding):
    """All sentences in one process."""
    script = [f'({voice})']
    for i, text in enumerate(texts):
        quoted = text.replace('\\', '').replace('"', '')
        script.append(f'(set! u (utt.synth (Utterance Text "{quoted}")))')
        script.append(f'(utt.save.wave u "{folder}/{i}.wav" (quote riff)) (utt.save.segs u "{folder}/{i}.lab")')
    path = os.path.join(folder, 'script.scm')
    with open(path, 'w', encoding=encoding, errors='ignore') as file:
        file.write('\n'.join(script))
    subprocess.run(['festival', '-b', path], capture_output=True, check=False)
    for i in range(len(texts)):
        if not os.path.exists(f'{folder}/{i}.lab'):
            continue
        rate, sound = read_wave(f'{folder}/{i}.wav')
        with open(f'{folder}/{i}.lab', encoding=encoding) as file:
            rows = [line.split() for line in file if len(line.split()) == 3]
        yield rate, sound, labels_of([float(row[0]) for row in rows], [row[2] for row in rows], names)


def shaped(noise, count, rate):
    """Noise whose power falls with the frequency to a random power, or that of a hum."""
    spectrum = np.fft.rfft(noise.standard_normal(count))
    hz = np.fft.rfftfreq(count, 1 / rate)
    spectrum *= np.maximum(hz, 50.0) ** noise.uniform(-1.0, 0.2)
    sound = np.fft.irfft(spectrum, count)
    return (sound / np.sqrt(np.mean(sound ** 2) + 1e-12)).astype(np.float32)


def disturbed(sound, rate, noise):
    """As through a room, a microphone and an amplifier: echoes, colour, noise, gain."""
    power = np.sqrt(np.mean(sound ** 2) + 1e-12)
    if noise.random() < 0.5:
        tail = int(rate * noise.uniform(0.05, 0.3))
        echo = noise.standard_normal(tail) * np.exp(-np.linspace(0, 6, tail)) * noise.uniform(0.005, 0.05)
        echo[0] = 1.0
        sound = np.fft.irfft(np.fft.rfft(sound, len(sound) + tail) * np.fft.rfft(echo, len(sound) + tail))[:len(sound)]
    spectrum = np.fft.rfft(sound)
    hz = np.fft.rfftfreq(len(sound), 1 / rate)
    octaves = np.log2(np.maximum(hz, 60) / 1000)
    gain = noise.uniform(-2.5, 2.5) * octaves  # dB
    for _ in range(3):
        gain += noise.uniform(-5, 5) * np.exp(-0.5 * ((octaves - noise.uniform(-3, 3)) / noise.uniform(0.3, 1.0)) ** 2)
    if noise.random() < 0.15:
        gain -= 60 * (hz > noise.uniform(3400, 5000))
    if noise.random() < 0.3:
        gain -= np.minimum(40, 12 * np.maximum(0, np.log2(noise.uniform(80, 250) / np.maximum(hz, 20))))
    sound = np.fft.irfft(spectrum * 10 ** (gain / 20), len(sound))
    sound *= power / np.sqrt(np.mean(sound ** 2) + 1e-12)
    sound += shaped(noise, len(sound), rate) * power * 10 ** (-noise.uniform(8, 45) / 20)
    return sound * 10 ** (noise.uniform(-26, 2) / 20)


def write(folder, name, rate, sound, labels, noise, augment):
    """With silence around it; trained ones are disturbed, and faster or slower with their formants."""
    before, after = noise.uniform(0.05, 0.8), noise.uniform(0.1, 0.6)
    sound = np.concatenate([np.zeros(int(before * rate)), sound, np.zeros(int(after * rate))])
    labels = [(begin + before, end + before, ipa) for begin, end, ipa in labels]
    factor = 1.0
    if augment:
        factor = noise.uniform(0.82, 1.22)
        sound = disturbed(sound, rate, noise)
    rate = int(rate * factor)
    os.makedirs(folder, exist_ok=True)
    with wave.open(f'{folder}/{name}.wav', 'wb') as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes((np.clip(sound, -1, 1) * 32767).astype('<i2').tobytes())
    with open(f'{folder}/{name}.txt', 'w', encoding='utf-8') as file:
        for begin, end, ipa in labels:
            if end > begin:
                file.write(f'{begin / factor:.4f}\t{end / factor:.4f}\t{ipa}\n')
    return len(sound) / rate


def main():
    program, folder = sys.argv[1], sys.argv[2]
    minutes = float(sys.argv[3]) if len(sys.argv) > 3 else 180
    noise, chance = np.random.default_rng(7), random.Random(7)
    texts = {language: sentences(language) for language in ('en', 'pt', 'it')}
    for language, found in texts.items():
        chance.shuffle(found)
        print(language, len(found), 'sentences')
    text_of = lambda language: chance.choice(texts[language])

    def fill(kind, name, seconds, make):
        made, i = 0.0, 0
        while made < seconds:
            for rate, sound, labels in make():
                made += write(os.path.join(folder, kind), f'{name}_{i}', rate, sound, labels, noise, kind == 'train')
                i += 1
        print(kind, name, round(made), 's', flush=True)

    def of_espeak(language, voices, variants):
        voice = chance.choice(voices) + chance.choice(variants)
        return [espeak(program, text_of(language), language, voice, chance.uniform(0.75, 1.4), chance.uniform(0.7, 1.4))]

    def of_festival(voice, names, language, encoding='utf-8'):
        with tempfile.TemporaryDirectory() as place:
            some = chance.sample(FINNISH_TEXT if language == 'fi' else texts[language], 12)
            yield from festival(some, voice, names, place, encoding)

    heard = ['', '+m1', '+m2', '+m3', '+m4', '+m7', '+f1', '+f2', '+f3', '+f5', '+klatt', '+klatt2', '+croak']
    unheard = ['+m6', '+f4', '+klatt3']
    place = tempfile.mkdtemp()
    part = minutes * 60 / 22
    fill('train', 'espeak_en', 3 * part, lambda: of_espeak('en', ['en-us', 'en-gb-x-rp'], heard))
    fill('train', 'espeak_pt', 4 * part, lambda: of_espeak('pt', ['pt-br'], heard))
    fill('train', 'espeak_it', 1 * part, lambda: of_espeak('it', ['it'], heard))
    for voice, parts in (('awb', 3), ('rms', 3), ('slt', 2), ('kal16', 1)):
        fill('train', 'flite_' + voice, parts * part, lambda voice=voice: [flite(text_of('en'), voice, place)])
    fill('train', 'festival_slt', 3 * part, lambda: of_festival('voice_cmu_us_slt_arctic_hts', CMU, 'en'))
    fill('train', 'festival_lp', 2 * part, lambda: of_festival('voice_lp_diphone', ITALIAN, 'it', 'latin-1'))
    fill('espeak_en', 'espeak', 120, lambda: of_espeak('en', ['en-us'], unheard))
    fill('espeak_pt', 'espeak_pt', 120, lambda: of_espeak('pt', ['pt-br'], unheard))
    fill('festival_ked', 'ked', 120, lambda: of_festival('voice_ked_diphone', CMU, 'en'))
    fill('festival_pc', 'pc', 120, lambda: of_festival('voice_pc_diphone', ITALIAN, 'it', 'latin-1'))
    for voice, short in (('voice_suo_fi_lj_diphone', 'lj'), ('voice_hy_fi_mv_diphone', 'mv')):
        fill('festival_fi', short, 60, lambda voice=voice: of_festival(voice, FINNISH, 'fi', 'latin-1'))


if __name__ == '__main__':
    main()
