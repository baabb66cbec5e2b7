/* Of musl: instructions of a processor. None is used, for equal bytes. */
