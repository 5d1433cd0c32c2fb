#!/usr/bin/env python3
"""People's recordings with the times of their sounds, to measure the listener: README.md.

    human.py FOLDER

Of Debian's pocketsphinx-testdata (readers of LibriVox and of numbers, cards and commands, in English), aligned with what they say by
pocketsphinx and its model (pocketsphinx-en-us): the grammar is the sounds of the sentence, by every pronunciation of its dictionary.
Writes FOLDER/NAME.wav and NAME.txt as corpus.py does.
"""
import os
import subprocess
import sys
import wave

from cmu import CMU

DATA = '/usr/share/pocketsphinx/test/data'
MODEL = '/usr/share/pocketsphinx/model/en-us'
COMMANDS = {
    'goforward.raw': 'go forward ten meters', 'something.raw': 'go somewhere and do something',
    'tidigits/dhd.2934z.raw': 'two nine three four zero',
}


def recordings():
    for folder in ('cards', 'librivox'):
        name = 'cards/cards.transcription' if folder == 'cards' else 'librivox/transcription'
        with open(f'{DATA}/{name}', encoding='utf-8') as file:
            for line in file:
                words, name = line.replace('<s>', '').split('</s>')
                yield f'{DATA}/{folder}/{name.strip(" ()" + chr(10))}.wav', words.split()
    for name, words in COMMANDS.items():
        yield f'{DATA}/{name}', words.split()


def dictionary():
    """Of each word its pronunciations."""
    found = {}
    with open(f'{MODEL}/cmudict-en-us.dict', encoding='utf-8') as file:
        for line in file:
            word, *phones = line.split()
            found.setdefault(word.split('(')[0], []).append(' '.join(phones))
    return found


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    words_of = dictionary()
    with open(f'{folder}/phones.dict', 'w', encoding='utf-8') as file:
        file.writelines(f'{phone.upper()} {phone.upper()}\n' for phone in CMU if phone not in ('ax', 'axr', 'dx', 'el', 'em', 'en', 'hv', 'nx'))
    for path, words in recordings():
        name = os.path.splitext(os.path.basename(path))[0]
        with open(f'{folder}/{name}.gram', 'w', encoding='utf-8') as file:
            said = ' '.join('( ' + ' | '.join(words_of[word]) + ' )' for word in words)
            file.write(f'#JSGF V1.0;\ngrammar said;\npublic <said> = {said};\n')
        told = subprocess.run(
            ['pocketsphinx_continuous', '-infile', path, '-hmm', f'{MODEL}/en-us', '-dict', f'{folder}/phones.dict', '-jsgf', f'{folder}/{name}.gram',
             '-time', 'yes', '-logfn', '/dev/null', '-remove_silence', 'no', '-fsgusealtpron', 'no', '-beam', '1e-120', '-wbeam', '1e-120', '-pbeam', '1e-120'],
            capture_output=True, check=True).stdout.decode().split('\n')
        rows = [line.split() for line in told if len(line.split()) == 4]
        with open(f'{folder}/{name}.txt', 'w', encoding='utf-8') as file:
            for phone, begin, end, _ in rows:
                if float(end) <= float(begin) or phone == '(NULL)':
                    continue
                file.write(f'{float(begin):.3f}\t{float(end) + 0.01:.3f}\t{CMU.get(phone.lower(), "")}\n')
        data = open(path, 'rb').read()
        if data[:4] != b'RIFF':
            with wave.open(f'{folder}/{name}.wav', 'wb') as file:
                file.setnchannels(1)
                file.setsampwidth(2)
                file.setframerate(16000)
                file.writeframes(data)
        else:
            with open(f'{folder}/{name}.wav', 'wb') as file:
                file.write(data)
        print(name, ' '.join(words), len(rows), 'sounds')


if __name__ == '__main__':
    main()
