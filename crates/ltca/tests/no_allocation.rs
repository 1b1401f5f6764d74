//! The step of the contact of given poses takes no memory.
#![allow(unsafe_code, reason = "an allocator that counts is one")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

use ale::Station;
use contact::slice::MeshContact;
use nalgebra::{UnitQuaternion, Vector3};
use testing::generated;

thread_local! {
    static TAKEN: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, counting on each thread.
struct Counting;

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        TAKEN.with(|t| t.set(t.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        TAKEN.with(|t| t.set(t.get() + 1));
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    let case = generated(20.0, [3, 2, 2, 6, 1]);
    for friction in [0.0, 0.06] {
        let options = case.slice_options().with_contact(|c| c.friction = friction);
        let mut model = case.reduced(options);
        let steps: Vec<_> = (0..24)
            .map(|i| {
                model.advance(Station { cycle: 0, phase: f64::from(i) / 24.0 }, |_| ()).unwrap();
                model.last().unwrap().poses
            })
            .collect();
        let mut mesh = MeshContact::new(model.pair(), model.contact_set().clone(), &model.options().contact).unwrap();
        // The first one fills what the linear algebra keeps for itself.
        mesh.evaluate(&steps[0]).unwrap();
        let before = TAKEN.get();
        for (i, poses) in steps.iter().enumerate() {
            let mut poses = *poses;
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 1e-5 * (i % 5) as f64);
            poses[1].append_rotation_wrt_center_mut(&turn);
            mesh.evaluate(&poses).unwrap();
        }
        let taken = TAKEN.get() - before;
        assert_eq!(taken, 0, "friction {friction}: {taken} allocations in {} steps", steps.len());
    }
}
