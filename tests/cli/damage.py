"""Ways to damage a file's bytes. Each takes the bytes and a random.Random, and returns other bytes."""


def cut(data, random):
    return data[:random.randrange(len(data))]


def flip_bit(data, random):
    changed = bytearray(data)
    changed[random.randrange(len(data))] ^= 1 << random.randrange(8)
    return bytes(changed)


def _replace(data, start, block):
    return data[:start] + block + data[start + len(block):]


def random_bytes(data, random):
    length = random.randrange(1, 64)
    return _replace(data, random.randrange(len(data) - length), random.randbytes(length))


def lose_sector(data, random):
    """What a disk does: 512 bytes read as zeros, or as another sector's."""
    sectors = len(data) // 512
    source = 512 * random.randrange(sectors)
    block = bytes(512) if random.random() < 0.5 else data[source:source + 512]
    return _replace(data, 512 * random.randrange(sectors), block)


def lose_end(data, random):
    """The file has its length, but its end was never written."""
    start = random.randrange(len(data))
    return data[:start] + bytes(len(data) - start)


kinds = (cut, flip_bit, flip_bit, flip_bit, random_bytes, lose_sector, lose_end)
