#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The scripts of `renderer completion` in the shells themselves: completion_test.py RENDERER. Skips shells that are missing."""

import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

RENDERER = Path(sys.argv[1]).resolve()

# The script, then what COMPREPLY is for words, of which the last one is being typed.
BASH = r"""
source <(renderer completion bash)
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
compopt() { :; }
_plumb_renderer
printf '%s\n' "${COMPREPLY[@]}"
"""


def in_directory(test):
    """With the renderer in PATH, and a scene in the working directory."""

    def run(self):
        with tempfile.TemporaryDirectory() as directory:
            Path(directory, "bin").mkdir()
            os.symlink(RENDERER, Path(directory, "bin", "renderer"))
            Path(directory, "a scene.xml").touch()
            environment = dict(os.environ, PATH=f"{directory}/bin:{os.environ['PATH']}", HOME=directory, TERM="dumb")
            test(self, directory, environment)

    return run


class CompletionTest(unittest.TestCase):
    def needs(self, shell):
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")

    @in_directory
    def test_bash(self, directory, environment):
        self.needs("bash")

        def complete(*words):
            done = subprocess.run(["bash", "--norc", "-c", BASH, "bash", *words], cwd=directory, env=environment,
                                  capture_output=True, text=True, check=True)
            self.assertEqual(done.stderr, "")
            return done.stdout.splitlines()

        self.assertEqual(complete("renderer", "comp"), ["compare", "completion"])
        self.assertEqual(complete("renderer", "compare", "--varia"), ["--variance-of"])
        self.assertEqual(complete("renderer", "a scene.xml", "--sampler", "so"), ["sobol"])
        self.assertEqual(complete("renderer", "a scene.xml", "--sampler", "=", "so"), ["sobol"])
        self.assertEqual(sorted(complete("renderer", "check", "")), ["a scene.xml", "bin"])
        self.assertEqual(complete("renderer", "check", "a s"), ["a scene.xml"])

    @in_directory
    def test_fish(self, directory, environment):
        self.needs("fish")

        def complete(line):
            command = "renderer completion fish | source; complete -C (cat)"
            done = subprocess.run(["fish", "--no-config", "-c", command], input=line, cwd=directory, env=environment,
                                  capture_output=True, text=True, check=True)
            return [one.split("\t")[0] for one in done.stdout.splitlines()]

        self.assertEqual(complete("renderer comp"), ["compare", "completion"])
        self.assertEqual(complete("renderer compare --varia"), ["--variance-of"])
        self.assertEqual(complete("renderer x.xml --sampler so"), ["sobol"])
        self.assertIn("a scene.xml", [one.replace("\\ ", " ") for one in complete("renderer check a")])

    @in_directory
    def test_zsh(self, directory, environment):
        self.needs("zsh")

        def complete(line):
            """What the line is after the key Tab."""
            pid, terminal = pty.fork()
            if pid == 0:
                os.chdir(directory)
                os.execvpe("zsh", ["zsh", "-f", "-i"], environment)
            text = b""

            def until(mark):
                nonlocal text
                end = time.monotonic() + 60
                while mark not in text and time.monotonic() < end:
                    if select.select([terminal], [], [], 1)[0]:
                        text += os.read(terminal, 4096)
                self.assertIn(mark, text)
                text = text.split(mark, 1)[1]

            os.write(terminal, b"PS1='prompt''> '; unsetopt zle_bracketed_paste; autoload -Uz compinit; compinit -u -D; "
                               b"source <(renderer completion zsh); bindkey '^I' complete-word; "
                               b"show() { print -r -- \"[[$BUFFER]]\"; zle send-break }; zle -N show; bindkey '^X' show\r")
            until(b"prompt> ")
            os.write(terminal, line.encode() + b"\t")
            os.write(terminal, b"\x18")
            until(b"[[")
            while b"]]" not in text:
                text += os.read(terminal, 4096)
            os.write(terminal, b"exit\r")
            os.close(terminal)
            os.waitpid(pid, 0)
            return text.split(b"]]")[0].decode()

        self.assertEqual(complete("renderer compa"), "renderer compare ")
        self.assertEqual(complete("renderer compare --varia"), "renderer compare --variance-of ")
        self.assertEqual(complete("renderer x.xml --sampler so"), "renderer x.xml --sampler sobol ")
        self.assertEqual(complete("renderer check a"), "renderer check a\\ scene.xml ")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
