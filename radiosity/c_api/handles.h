#pragma once

#include "radiosity/c_api/hemicube.h"
#include "radiosity/radiosity.h"

#include <atomic>
#include <cstring>
#include <new>

namespace hemicube::radiosity::c_api {

/// What all handles begin with. A handle lives until its owner has released it and no call uses it.
struct Handle {
  mutable std::atomic<std::uint32_t> holders{1};
};

/// How many handles there are: while there are any, the allocator stays.
inline std::atomic<std::uint64_t> g_handle_count{0};

template <typename T> Status make_handle(T** made) noexcept {
  ++g_handle_count;
  void* memory = detail::allocate(sizeof(T));
  if (memory == nullptr) {
    --g_handle_count;
    return Status::error(StatusCode::kOutOfMemory, "out of memory: a handle");
  }
  *made = new (memory) T;
  return {};
}

/// @param handle  may be null
template <typename T> void release_handle(const T* handle) noexcept {
  if (handle == nullptr || --handle->holders != 0)
    return;
  handle->~T();
  detail::release(const_cast<T*>(handle), sizeof(T));
  --g_handle_count;
}

/// Keeps a handle while a call uses it, also if a callback releases it.
template <typename T> class Held {
public:
  explicit Held(const T* handle) noexcept : handle_(handle) {
    if (handle_ != nullptr)
      ++handle_->holders;
  }
  ~Held() { release_handle(handle_); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

private:
  const T* handle_;
};

/// A handle in the making: released unless it is given away.
template <typename T> class NewHandle {
public:
  NewHandle() = default;
  ~NewHandle() { release_handle(made_); }
  NewHandle(const NewHandle&) = delete;
  NewHandle& operator=(const NewHandle&) = delete;

  Status make() noexcept { return make_handle(&made_); }
  T* operator->() const noexcept { return made_; }
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.UndefReturn): make() has gone well
  T& operator*() const noexcept { return *made_; }
  void give(T** owner) noexcept {
    *owner = made_;
    made_ = nullptr;
  }

private:
  T* made_ = nullptr;
};

/// The code of a call's outcome; the text of a failure is kept for hc_error_text.
int finish(const Status& status) noexcept;

Status null_argument(const char* name) noexcept;

/// Takes a struct of the caller's, of this version or an earlier one: what it does not have yet is
/// 0.
/// @param least  size of the struct in its first version
template <typename T>
Status read_struct(const char* name, const T* from, std::size_t least, T* to) noexcept {
  *to = {};
  if (from == nullptr)
    return null_argument(name);
  const std::size_t size = from->struct_size;
  if (size < least || size > sizeof(T))
    return Status::error(StatusCode::kInvalidArgument, name, ": struct_size is ", size,
                         ", this version knows ", least, " to ", sizeof(T));
  std::memcpy(static_cast<void*>(to), from, size);
  return {};
}

/// Gives a struct to the caller, as much of it as the caller knows.
template <typename T>
Status write_struct(const char* name, const T& from, std::size_t least, T* to) noexcept {
  T known;
  HC_TRY(read_struct(name, static_cast<const T*>(to), least, &known));
  const std::size_t size = known.struct_size;
  known = from;
  known.struct_size = size;
  std::memcpy(static_cast<void*>(to), &known, size);
  return {};
}

/// @param name  of the argument
template <typename T>
Status copy_array(const char* name, const T* from, std::uint64_t count, Buffer<T>* to) noexcept {
  if (from == nullptr && count != 0)
    return null_argument(name);
  if (count > static_cast<std::size_t>(-1) / sizeof(T))
    return Status::error(StatusCode::kInvalidArgument, name, ": ", count, " do not fit in memory");
  return to->assign({from, static_cast<std::size_t>(count)});
}

/// Of a handle's certificate, or of what is not a handle's.
Status write_certificate(const Certificate& certificate, hc_certificate* to) noexcept;

} // namespace hemicube::radiosity::c_api

struct hc_scene : hemicube::radiosity::c_api::Handle {
  hemicube::radiosity::Scene scene; ///< without geometry, once there are patches
  hemicube::radiosity::PatchSet patches;
  hemicube::radiosity::MeshReport report;
  std::uint64_t hash = 0;
};

struct hc_form_factors : hemicube::radiosity::c_api::Handle {
  hemicube::radiosity::FormFactorMatrix matrix;
  hemicube::radiosity::Certificate certificate;
  bool are_all = false;       ///< row i is that of patch i
  std::uint64_t geometry = 0; ///< hash of the mesh
};

struct hc_solution : hemicube::radiosity::c_api::Handle {
  hemicube::radiosity::Solution solution;
  hemicube::radiosity::Certificate certificate;
};
