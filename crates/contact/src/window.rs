//! Flanks, matrices and solver of a sliding window.

use ale::ToothWindow;
use geometry::GearPair;
use reduction::ElasticGear;

use crate::{ContactError, ContactOptions, ContactSet, ElasticContact, MeshForce, Pose, slice::MeshContact};

/// The contact of one window: its flanks, and the solver of slices on reduced gears.
#[derive(Debug)]
pub struct WindowContact {
    /// Flanks and matrices.
    pub set: ContactSet,
    /// Solver; `None` for points, and for gears with all their degrees of freedom.
    pub slices: Option<MeshContact>,
}

impl WindowContact {
    /// Contact with the flanks and matrices of a window.
    ///
    /// # Errors
    /// [`ContactError`] if the solver cannot be set up.
    pub fn new(pair: &GearPair, set: ContactSet, options: &ContactOptions) -> Result<Self, ContactError> {
        let sliced = set.slices().is_some() && set.windows().is_some();
        let slices = sliced.then(|| MeshContact::new(pair, set.clone(), options)).transpose()?;
        Ok(Self { set, slices })
    }

    /// Forces of the mesh with the gears' frames at `poses`, and their tangent, for every kind of contact: points or
    /// slices, gears reduced or whole.
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
    pub fn evaluate(
        &mut self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        options: &ContactOptions,
        poses: &[Pose; 2],
    ) -> Result<MeshForce, ContactError> {
        match &mut self.slices {
            Some(slices) => slices.evaluate(poses).cloned(),
            None => ElasticContact { pair, gears, set: &self.set, options }.evaluate(poses),
        }
    }

    /// Enters another window, with the flanks and matrices of `set` if they serve it.
    ///
    /// # Errors
    /// [`ContactError`] if the window cannot be set up.
    pub fn enter(
        &mut self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        set: ContactSet,
        options: &ContactOptions,
    ) -> Result<(), ContactError> {
        match &mut self.slices {
            Some(slices) => {
                slices.enter_window(pair, gears, window, set, options)?;
                self.set = slices.contact_set().clone();
            }
            None => {
                self.set = match set.in_window(pair, gears, window, options)? {
                    Some(own) => own,
                    None => ContactSet::new(pair, gears, window, options)?,
                };
            }
        }
        Ok(())
    }
}
