"""The example for Godot 3 follows the stream of a server, without a window. Skipped where there is no godot3-server or godot3.

Usage: godot_test.py PATH_OF_SEMBLANTE PATH_OF_THE_LIBRARY"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[3]
PATIENCE = 600  # seconds; only a hang lasts so long, on however busy a machine

godot = os.environ.get("SEMBLANTE_GODOT") or shutil.which("godot3-server") or shutil.which("godot3")
if not godot or not shutil.which("cc"):
    print("skipped: neither godot3-server nor godot3 is installed")
    sys.exit(77)

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    project = folder / "project"
    shutil.copytree(TOP / "clients/godot", project)
    shutil.copytree(TOP / "protocol/vectors/face_colored", project / "package")
    shutil.copy(pathlib.Path(__file__).with_name("follow.gd"), project)
    installed = folder / "include/semblante"  # the header's place, as programs name it
    installed.mkdir(parents=True)
    os.symlink(TOP / "clients/runtime/semblante.h", installed / "semblante.h")
    library = pathlib.Path(sys.argv[2]).resolve()
    subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared", "-fvisibility=hidden", f"-I{folder}/include",
                    f"-I{TOP}", project / "semblante_godot.c", library, f"-Wl,-rpath,{library.parent}", "-o",
                    project / "libsemblante_godot.so"], check=True)
    server = subprocess.Popen([sys.argv[1], "serve", "--demo", "--port", "0", "--data", folder / "data"], stdout=subprocess.PIPE, text=True)
    try:
        address = re.fullmatch(r"semblante listening on http://(\S+)", server.stdout.readline().strip()).group(1).rstrip("/")
        said = subprocess.run([godot, "--no-window", "--path", project, "-s", "res://follow.gd"], capture_output=True, text=True,
                              timeout=PATIENCE + 60,
                              env={**os.environ, "HOME": name, "SEMBLANTE_STREAM": f"ws://{address}/v1/streams/demo",
                                   "SEMBLANTE_PATIENCE": str(PATIENCE)})
    finally:
        server.terminate()
        server.wait(PATIENCE)
    words = re.search(r"vertices (\d+) corners (\d+) shown (\d+) moved (\d+) colors (\d+) reddest ([\d.,]+)", said.stdout)
    assert words, said.stdout + said.stderr
    vertices, corners, shown, moved, colors = map(int, words.groups()[:5])
    assert (vertices, corners % 3) == (196, 0) and corners > 0 and shown >= 30 and moved > vertices // 4, words.group()
    assert (colors, words.group(6)) == (196, "1,0.462745,0.482353,1"), words.group()
    # Errors of the script, or that it reports; without a window the engine has some of its own.
    assert not re.search("SCRIPT ERROR|USER ERROR|face.gd", said.stdout + said.stderr), said.stdout + said.stderr
    print(words.group())
