#pragma once

#if !defined(HC_NO_THREADS)
#include <pthread.h>
#endif

namespace hemicube::radiosity {

/// Keeps workers from each other. Unlike std::mutex it has nothing to throw, and so does not bring
/// the exceptions of the C++ library into programs without any. With HC_NO_THREADS it is nothing.
class Mutex {
public:
  Mutex() = default;
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;

#if defined(HC_NO_THREADS)
  void lock() noexcept {}
  bool try_lock() noexcept {
    return true;
  }
  void unlock() noexcept {}
#else
  ~Mutex() {
    pthread_mutex_destroy(&mutex_);
  }
  void lock() noexcept {
    pthread_mutex_lock(&mutex_);
  }
  bool try_lock() noexcept {
    return pthread_mutex_trylock(&mutex_) == 0;
  }
  void unlock() noexcept {
    pthread_mutex_unlock(&mutex_);
  }
  /// For conditions that wait with this mutex locked.
  pthread_mutex_t* native() noexcept {
    return &mutex_;
  }

private:
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
#endif
};

/// Holds a mutex for the life of the object.
class MutexLock {
public:
  explicit MutexLock(Mutex& mutex) noexcept : mutex_(mutex) { mutex.lock(); }
  ~MutexLock() { mutex_.unlock(); }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

private:
  Mutex& mutex_;
};

} // namespace hemicube::radiosity
