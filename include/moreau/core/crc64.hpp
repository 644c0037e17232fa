// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace moreau::detail {

constexpr std::array<std::uint64_t, 256> make_crc64_table() {
  constexpr std::uint64_t polynomial = 0xc96c5795d7870f42;  // ECMA-182, bits in reversed order
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ (rest & 1 ? polynomial : 0);
    table[byte] = rest;
  }
  return table;
}
inline constexpr std::array<std::uint64_t, 256> crc64_table = make_crc64_table();

/// The CRC-64/XZ checksum of bytes. The checksum of "123456789" is 0x995dc9bbdf1939fa. It detects
/// every error that is confined to 64 consecutive bits.
/// @param before checksum of the preceding bytes if `bytes` continues them; 0 at the beginning
/// @returns checksum of the preceding bytes followed by `bytes`
constexpr std::uint64_t crc64(std::string_view bytes, std::uint64_t before = 0) {
  std::uint64_t rest = ~before;
  for (const char byte : bytes)
    rest = crc64_table[(rest ^ static_cast<unsigned char>(byte)) & 0xff] ^ (rest >> 8);
  return ~rest;
}

}  // namespace moreau::detail
