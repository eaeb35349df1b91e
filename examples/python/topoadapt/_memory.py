# SPDX-License-Identifier: MIT
"""Memory of a context, and NumPy arrays over parts of it that keep the memory alive."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np


class Block:
    """Memory of its own, or any writable buffer of the caller: bytearray, NumPy array, mmap."""

    def __init__(self, size: int, memory: Optional[Any] = None) -> None:
        if memory is None:
            memory = np.empty(size, np.uint8)
        self._data = np.frombuffer(memory, np.uint8)  # holds on to the buffer, which can then not be resized
        if not self._data.flags.writeable:
            raise ValueError("memory has to be writable")
        self.address = self._data.ctypes.data
        self.size = self._data.size


class Export:
    """A part of a block for NumPy. The array made from an export, and every array or memoryview derived from that, keep
    the export alive, so a weak reference to the export tells whether any of them is left. Read-only for good: NumPy
    refuses setflags(write=True) over an object without a writable buffer."""

    __slots__ = ("__array_interface__", "_block", "__weakref__")

    def __init__(self, block: Block, address: int, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
        self._block = block
        self.__array_interface__ = {
            "version": 3,
            "shape": shape,
            "typestr": dtype.str,
            "descr": dtype.descr,
            "data": (address, True),
        }
