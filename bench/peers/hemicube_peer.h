#pragma once

#include "bench/peers/peer.h"

namespace hemicube::bench {

/// This project, with the best instruction set of the machine.
/// @param threads  at least 1
std::unique_ptr<Peer> make_hemicube_peer(std::uint32_t threads);

} // namespace hemicube::bench
