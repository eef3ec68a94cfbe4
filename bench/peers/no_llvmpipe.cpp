#include "bench/peers/peer.h"

namespace hemicube::bench {

std::unique_ptr<Peer> make_llvmpipe_peer() {
  return nullptr;
}

} // namespace hemicube::bench
