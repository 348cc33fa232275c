//! Progress on standard error, when it is a terminal.

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
            _ => self.bar.set_message("joining"),
        }
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
