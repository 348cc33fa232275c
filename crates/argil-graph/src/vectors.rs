//! Loops over lanes, with the widest vectors that the processor at hand has.
//!
//! Without the feature `simd` they are built for the plainest processor of the target: the same results, more slowly.

/// Work whose loops over lanes the compiler makes vector instructions of. It has to be inlined, as all that it calls in such loops.
pub(crate) trait OverLanes {
    fn run(self);
}

/// The widest vectors there are.
#[derive(Clone, Copy)]
pub(crate) struct Vectors {
    #[cfg(feature = "simd")]
    arch: pulp::Arch,
}

impl Vectors {
    /// Those of this processor.
    pub(crate) fn here() -> Self {
        Self {
            #[cfg(feature = "simd")]
            arch: pulp::Arch::new(),
        }
    }

    #[cfg(feature = "simd")]
    pub(crate) fn run(self, work: impl OverLanes) {
        struct Dispatched<W>(W);

        impl<W: OverLanes> pulp::WithSimd for Dispatched<W> {
            type Output = ();

            #[inline(always)]
            fn with_simd<S: pulp::Simd>(self, _: S) {
                self.0.run();
            }
        }

        self.arch.dispatch(Dispatched(work));
    }

    #[cfg(not(feature = "simd"))]
    pub(crate) fn run(self, work: impl OverLanes) {
        work.run();
    }
}
