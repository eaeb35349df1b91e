// SPDX-License-Identifier: MIT
use crate::raw::struct_size;
use topoadapt_sys::tpa_remesh_options;

/// Settings of [`Context::remesh`](crate::Context::remesh).
#[derive(Clone, Copy, Debug)]
pub struct Remesh {
    pub(crate) raw: tpa_remesh_options,
}

impl Remesh {
    /// One sweep that aims at this length of edges, without relaxation.
    pub fn to_length(length: f64) -> Remesh {
        let struct_size = struct_size::<tpa_remesh_options>();
        Remesh { raw: tpa_remesh_options { struct_size, iterations: 1, target_length: length, ..Default::default() } }
    }

    /// Sweeps of split, collapse, flip and relax. 1 to 100.
    #[must_use]
    pub fn iterations(mut self, sweeps: u32) -> Remesh {
        self.raw.iterations = sweeps;
        self
    }

    /// Edges longer than `split` times the length are split, edges shorter than `collapse` times the length collapsed.
    /// 0 means 4/3 and 4/5 (Botsch & Kobbelt 2004). `collapse` is at most `split` / 1.5.
    #[must_use]
    pub fn ratios(mut self, split: f64, collapse: f64) -> Remesh {
        self.raw.split_ratio = split;
        self.raw.collapse_ratio = collapse;
        self
    }

    /// Tangential relaxation of vertices that an operation has touched. 0 to 1.
    #[must_use]
    pub fn relaxation(mut self, factor: f64) -> Remesh {
        self.raw.relaxation = factor;
        self
    }
}
