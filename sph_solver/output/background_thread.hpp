/// A thread for what need not be waited for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace cupel
{

/// Does what it is given, one task after the other, while its owner goes on. What a task throws ends the work: later
/// tasks are dropped, and whatever is asked from then on throws the same.
class BackgroundThread
{
public:
    using Task = std::function<void()>;

    BackgroundThread() = default;
    BackgroundThread(const BackgroundThread&) = delete;
    BackgroundThread& operator=(const BackgroundThread&) = delete;
    /// Waits for all that was given, in silence.
    ~BackgroundThread();

    /// Where the system gives no thread, the task is done before the return.
    void add(Task task);
    /// Waits until fewer than `count` tasks are left, the one under way among them.
    void wait_for_fewer_than(std::size_t count);
    void wait() { wait_for_fewer_than(1); }
    /// Waits for nothing.
    void check();

private:
    void work();
    void rethrow() const;

    std::mutex mutex_; ///< of all that follows but the thread
    std::condition_variable changed_;
    std::deque<Task> tasks_; ///< the one under way is the first
    std::exception_ptr thrown_;
    bool ending_ = false;
    std::thread thread_; ///< from the first task on
};

} // namespace cupel
