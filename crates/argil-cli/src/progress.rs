//! Progress on standard error, when it is a terminal.

use std::time::Duration;

use argil::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar that follows a plan; `indicatif` hides it where standard error is no terminal.
pub(crate) struct PlanBar {
    bar: ProgressBar,
}

impl PlanBar {
    pub(crate) fn new(quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{msg:>9} {wide_bar} {pos}/{len} layers, {eta} left")
        {
            bar.set_style(style);
        }
        bar.set_message("slicing");
        Self { bar }
    }

    pub(crate) fn follow(&self, progress: Progress) {
        match progress {
            Progress::Sliced { layers } => {
                self.bar.set_length(layers as u64);
                self.bar.set_message("planning");
            }
            Progress::Layer { .. } => self.bar.inc(1),
            Progress::Descended => self.bar.set_message("joining"),
            _ => {}
        }
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// How often the sign of a stage of unknown length turns.
const TICK: Duration = Duration::from_millis(150);

/// A turning sign with the time that a stage has taken so far, for those whose length nobody knows. It goes when it is
/// dropped; `indicatif` hides it where standard error is no terminal.
pub(crate) struct Waiting(ProgressBar);

impl Waiting {
    pub(crate) fn new(stage: &'static str, quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let sign = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{msg:>9} {spinner} {elapsed}") {
            sign.set_style(style);
        }
        sign.set_message(stage);
        if !sign.is_hidden() {
            sign.enable_steady_tick(TICK);
        }
        Self(sign)
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
