//! Pairs whose gears are already reduced, shared by cases of one plan that differ in shafts, bearings and flanks.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use answer::Remark;
use fem::Wanted;
use geometry::GearPair;
use ltca::StaticOptions;
use reduction::ElasticGear;
use scene::Scene;

use crate::{
    AnalysisError, GearCache, MapKey, Progress,
    alike::kind,
    elastic_gears::{ElasticGears, RecordKeys, elastic_gears},
    inputs::meshes_of,
    meshes::SceneMesh,
};

/// Pairs that are kept at the most; the one that was made first goes first.
const MOST: usize = 16;

/// Meshes of a pair and its gears, reduced.
#[derive(Debug)]
pub(crate) struct ReducedPair {
    pub meshes: [SceneMesh; 2],
    pub gears: Arc<[ElasticGear; 2]>,
    keys: RecordKeys,
    /// What was wrong with files of the cache.
    pub remarks: Vec<Remark>,
    saved: AtomicBool,
}

impl ReducedPair {
    /// Key of the contact maps of these gears in a store; `None` if the gears have no keys. `contact` is a text of
    /// everything else on which the contact depends.
    pub fn map_key(&self, contact: &str) -> Option<MapKey> {
        let keys: Option<Vec<_>> = self.keys.keys().iter().copied().collect();
        keys.map(|keys| MapKey::new(&keys, contact))
    }

    /// Stores the gears for later runs, once; returns remarks about write errors.
    pub fn save(&self, cache: &dyn GearCache) -> Vec<Remark> {
        if !cache.is_on() || self.saved.swap(true, Ordering::Relaxed) {
            return Vec::new();
        }
        self.keys.save(cache, &self.gears)
    }
}

/// One pair; whoever comes while it is being reduced waits for it.
struct Known {
    kind: Scene,
    window: Option<usize>,
    pair: Arc<Mutex<Option<Arc<ReducedPair>>>>,
}

/// Pairs by what meshes and matrices depend on.
#[derive(Default)]
pub(crate) struct ReducedPairs(Mutex<Vec<Known>>);

impl ReducedPairs {
    /// The pair of a scene with its gears reduced. Sharing does not change any bit of a result.
    ///
    /// # Errors
    /// [`AnalysisError`] if a mesh is not suitable for the analysis; [`AnalysisError::Cancelled`].
    pub fn of(
        &self,
        scene: &Scene,
        pair: &GearPair,
        options: &StaticOptions,
        (cache, progress, wanted): (&dyn GearCache, &dyn Progress, Wanted<'_>),
    ) -> Result<Arc<ReducedPair>, AnalysisError> {
        let (own, window) = (kind(scene), options.window);
        let place = {
            let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            match known.iter().find(|k| k.window == window && k.kind == own) {
                Some(found) => Arc::clone(&found.pair),
                None => {
                    if known.len() == MOST {
                        known.remove(0);
                    }
                    let pair = Arc::default();
                    known.push(Known { kind: own, window, pair: Arc::clone(&pair) });
                    pair
                }
            }
        };
        let mut made = place.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pair) = &*made {
            return Ok(Arc::clone(pair));
        }
        let meshes = meshes_of(scene, pair, None, cache)?;
        let ElasticGears { gears, keys, remarks } =
            elastic_gears(scene, pair, options, &meshes, (cache, progress, wanted), false)?;
        let pair = ReducedPair { meshes, gears: Arc::new(gears), keys, remarks, saved: AtomicBool::new(false) };
        Ok(Arc::clone(made.insert(Arc::new(pair))))
    }
}
