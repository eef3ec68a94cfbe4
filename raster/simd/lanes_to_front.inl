// Which bytes of a vector of four lanes bring those of a mask to the front, for instruction sets
// that shuffle bytes: worked out once, at compile time. Included into the namespace of an ISA.
struct LanesToFront {
  alignas(16) uint8_t bytes[16][16]; ///< [mask]; what follows the lanes of the mask is byte 0
  constexpr LanesToFront() : bytes() {
    for (int m = 0; m < 16; ++m) {
      int k = 0;
      for (int lane = 0; lane < 4; ++lane)
        if ((m >> lane & 1) != 0)
          for (int byte = 0; byte < 4; ++byte)
            bytes[m][k++] = static_cast<uint8_t>(lane * 4 + byte);
    }
  }
};
static constexpr LanesToFront kLanesToFront;
