# SPDX-License-Identifier: MIT
"""The caller's threads of tpa_exec. Tasks of the library run without the interpreter lock."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable

from . import _structures as s


class Pool:
    """Threads that share tasks with the calling thread, each a run of neighbouring indices, the same in every call."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._workers = ThreadPoolExecutor(threads - 1, "topoadapt")
        self.parallel_for = s.PARALLEL_FOR(self._share)

    def _share(self, user: Any, count: int, task: Callable[[Any, int], None], data: Any) -> None:
        def run(part: int) -> None:
            for index in range(count * part // parts, count * (part + 1) // parts):
                task(data, index)

        parts = min(self.threads, count)
        others = [self._workers.submit(run, part) for part in range(1, parts)]
        run(0)
        for other in others:
            other.result()
