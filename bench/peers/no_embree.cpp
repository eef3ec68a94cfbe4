#include "bench/peers/peer.h"

namespace hemicube::bench {

std::unique_ptr<Peer> make_embree_peer(bool) {
  return nullptr;
}

} // namespace hemicube::bench
