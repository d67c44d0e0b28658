#include "output/background_thread.hpp"

#include <pthread.h>
#include <sched.h>
#include <system_error>

namespace cupel
{

BackgroundThread::~BackgroundThread()
{
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void BackgroundThread::rethrow() const
{
    if (thrown_) std::rethrow_exception(thrown_);
}

void BackgroundThread::add(Task task)
{
    std::unique_lock lock(mutex_);
    rethrow();
    if (!thread_.joinable()) {
        try {
            thread_ = std::thread([this] { work(); });
        }
        catch (const std::system_error&) {
            lock.unlock();
            return task();
        }
    }
    tasks_.push_back(std::move(task));
    changed_.notify_all();
}

void BackgroundThread::wait_for_fewer_than(std::size_t count)
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.size() < count; });
    rethrow();
}

void BackgroundThread::check()
{
    const std::lock_guard lock(mutex_);
    rethrow();
}

void BackgroundThread::work()
{
    // Where all processors have work, its owner goes on, and this thread waits for its share of one.
    const sched_param no_priority{};
    static_cast<void>(::pthread_setschedparam(::pthread_self(), SCHED_BATCH, &no_priority));
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return ending_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        const Task& task = tasks_.front(); // a deque's first stays in place while others are added
        lock.unlock();
        std::exception_ptr thrown;
        try {
            task();
        }
        catch (...) {
            thrown = std::current_exception();
        }
        lock.lock();
        thrown_ = thrown;
        if (thrown_)
            tasks_.clear();
        else
            tasks_.pop_front();
        changed_.notify_all();
        if (thrown_) return;
    }
}

} // namespace cupel
