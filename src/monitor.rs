//! Progress and cancelling: how a computation is watched, never what it computes.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The computation was told to stop; nothing it had so far is returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// Who watches a computation. A run with a monitor gives the same result as a run without.
pub trait Monitor: Sync {
    /// Told that `phase` is under way and that `fraction` (0 to 1, never falling) of the whole is done.
    fn progress(&self, phase: &str, fraction: f64);
    /// Asked often; once true, the computation returns [`Cancelled`] at its next check.
    fn is_cancelled(&self) -> bool;
}

/// Watches nothing and never cancels.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Monitor for Silent {
    fn progress(&self, _phase: &str, _fraction: f64) {}
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// A stretch of a computation's progress, handed down to the function that fills it.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    monitor: &'a dyn Monitor,
    workers: NonZeroUsize,
    phase: &'static str,
    from: f64,
    to: f64,
    reports: bool,
}

impl<'a> Stage<'a> {
    /// The whole of a computation, from 0 to 1, on `workers` threads (wasm always uses one).
    pub fn whole(monitor: &'a dyn Monitor, workers: NonZeroUsize) -> Self {
        Self { monitor, workers, phase: "", from: 0.0, to: 1.0, reports: true }
    }

    /// A whole computation that nobody watches, on one thread.
    pub fn silent() -> Stage<'static> {
        Stage::whole(&Silent, NonZeroUsize::MIN)
    }

    /// The part of this stage between the fractions `from` and `to`, under a name that a person reads.
    #[must_use]
    pub fn part(&self, phase: &'static str, from: f64, to: f64) -> Self {
        let at = |t: f64| self.from + (self.to - self.from) * t;
        Self { phase, from: at(from), to: at(to), ..*self }
    }

    /// The same under this stage's own name.
    #[must_use]
    pub fn share(&self, from: f64, to: f64) -> Self {
        self.part(self.phase, from, to)
    }

    /// This stage on one thread.
    #[must_use]
    pub fn alone(&self) -> Self {
        Self { workers: NonZeroUsize::MIN, ..*self }
    }

    /// This stage without reports: for a step too small to be seen, which can still be cancelled.
    #[must_use]
    pub fn quiet(&self) -> Self {
        Self { reports: false, ..*self }
    }

    /// Reports that `fraction` of this stage is done and returns [`Cancelled`] if the computation shall stop.
    pub fn at(&self, fraction: f64) -> Result<(), Cancelled> {
        if self.monitor.is_cancelled() {
            return Err(Cancelled);
        }
        if self.reports {
            let done = self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0);
            self.monitor.progress(self.phase, done);
        }
        Ok(())
    }

    /// `f(0), …, f(count − 1)` in order, computed on this stage's workers. `f` must not depend on the order of
    /// its calls, so that the result is the same for any number of workers.
    pub fn map<T: Send>(&self, count: usize, f: impl Fn(usize) -> T + Sync) -> Result<Vec<T>, Cancelled> {
        self.at(0.0)?;
        let results = if self.workers.get() == 1 || cfg!(target_arch = "wasm32") {
            (0..count).map(|i| self.at(i as f64 / count as f64).map(|()| f(i))).collect::<Result<_, _>>()?
        } else {
            self.map_on_threads(count, f)?
        };
        self.at(1.0)?;
        Ok(results)
    }

    fn map_on_threads<T: Send>(
        &self,
        count: usize,
        f: impl Fn(usize) -> T + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        let next = AtomicUsize::new(0);
        let take = |reports: bool| -> Result<Vec<(usize, T)>, Cancelled> {
            let mut mine = Vec::new();
            loop {
                let i = next.fetch_add(1, Ordering::Relaxed);
                if i >= count {
                    return Ok(mine);
                }
                // Only one thread reports, so that what the monitor sees never falls.
                if reports {
                    self.at(i as f64 / count as f64)?;
                } else if self.monitor.is_cancelled() {
                    return Err(Cancelled);
                }
                mine.push((i, f(i)));
            }
        };
        let mut indexed = std::thread::scope(|scope| {
            let others: Vec<_> = (1..self.workers.get()).map(|_| scope.spawn(|| take(false))).collect();
            let mut all = take(true)?;
            for other in others {
                match other.join() {
                    Ok(part) => all.extend(part?),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            Ok(all)
        })?;
        indexed.sort_unstable_by_key(|(i, _)| *i);
        Ok(indexed.into_iter().map(|(_, t)| t).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[derive(Default)]
    struct Recorder {
        seen: Mutex<Vec<f64>>,
    }

    impl Monitor for Recorder {
        fn progress(&self, _phase: &str, fraction: f64) {
            self.seen.lock().unwrap().push(fraction);
        }
        fn is_cancelled(&self) -> bool {
            false
        }
    }

    #[test]
    fn map_keeps_order_and_progress_rises_to_one() {
        for workers in [1, 2, 5] {
            let recorder = Recorder::default();
            let stage = Stage::whole(&recorder, NonZeroUsize::new(workers).unwrap());
            let squares = stage.map(100, |i| i * i).unwrap();
            assert_eq!(squares, (0..100).map(|i| i * i).collect::<Vec<_>>());
            let seen = recorder.seen.into_inner().unwrap();
            assert!(seen.is_sorted(), "{workers} workers: {seen:?}");
            assert_eq!(seen.last(), Some(&1.0));
        }
    }

    /// Cancels once it was asked four times.
    struct Impatient(AtomicUsize);

    impl Monitor for Impatient {
        fn progress(&self, _phase: &str, _fraction: f64) {}
        fn is_cancelled(&self) -> bool {
            self.0.fetch_add(1, Ordering::Relaxed) >= 4
        }
    }

    #[test]
    fn map_stops_when_told() {
        for workers in [1, 3] {
            let impatient = Impatient(AtomicUsize::new(0));
            let stage = Stage::whole(&impatient, NonZeroUsize::new(workers).unwrap());
            assert_eq!(stage.map(1000, |i| i), Err(Cancelled));
        }
    }
}
