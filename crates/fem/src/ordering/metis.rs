//! The one call into the METIS library.
#![allow(unsafe_code)] // a C function; the lengths it relies on are checked right here

use std::{ptr, sync::Mutex};

use super::graph::Graph;
use crate::FemError;

/// METIS draws from the C library's global random numbers: two calls at a time would make either's result
/// depend on the other's timing.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Fill-reducing order of the graph's groups, `order[new] = group`.
///
/// # Errors
/// [`FemError::Ordering`] when METIS reports a failure.
pub(super) fn nested_dissection(graph: &Graph) -> Result<Vec<usize>, FemError> {
    let nodes = graph.group_count();
    if nodes < 2 || graph.neighbours.is_empty() {
        return Ok((0..nodes).collect());
    }
    let mut count = nodes as i32; // the graph has been checked to fit
    let (mut starts, mut neighbours) = (graph.starts.clone(), graph.neighbours.clone());
    let mut weights = graph.weights.clone();
    let uniform = weights.iter().all(|&w| w == weights[0]);
    let weights = if uniform { ptr::null_mut() } else { weights.as_mut_ptr() };
    let (mut order, mut inverse) = (vec![0i32; nodes], vec![0i32; nodes]);
    let mut options = [0i32; metis_sys::METIS_NOPTIONS as usize];
    let guard = ONE_AT_A_TIME.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    // SAFETY: `starts` has `count + 1` entries, ascending from 0 to the length of `neighbours`, whose entries
    // are below `count`; `order` and `inverse` have `count`; `options` has the length METIS declares;
    // all outlive the call.
    let status = unsafe {
        metis_sys::METIS_SetDefaultOptions(options.as_mut_ptr());
        metis_sys::METIS_NodeND(
            &mut count,
            starts.as_mut_ptr(),
            neighbours.as_mut_ptr(),
            weights,
            options.as_mut_ptr(),
            order.as_mut_ptr(),
            inverse.as_mut_ptr(),
        )
    };
    drop(guard);
    if status != metis_sys::rstatus_et_METIS_OK {
        return Err(FemError::Ordering { nodes, status });
    }
    Ok(order.into_iter().map(|group| group as usize).collect())
}
