//! Local ratings, method A: stresses of the solved contact against what the standard's materials bear.

/// Contact stress of a point of a flank, MPa.
///
/// ```text
/// sigma_H = Z_beta p sqrt(K_A K_V)
/// ```
/// `pressure` p: the Hertz pressure that the solved load puts on the point, MPa, which has the distribution over face and pairs (K_Hbeta, K_Halpha) in it; `helix_factor` Z_beta: what the standard adds to Hertz for helical teeth by experience, so that an evenly spread load has the contact stress of the standard; `load_factor` K_A K_V: what the solution does not know. Pressure is taken to grow with the root of the load. Source: ISO 6336-2, method A of the contact stress.
pub fn local_contact_stress(pressure: f64, helix_factor: f64, load_factor: f64) -> f64 {
    helix_factor * pressure * load_factor.sqrt()
}

/// Safety of a point of a flank against pitting.
///
/// ```text
/// S_H = sigma_HG / sigma_H
/// ```
/// `limit` sigma_HG, MPa; sigma_H that of [`local_contact_stress`]. NaN where nothing presses.
pub fn local_pitting_safety(limit: f64, pressure: f64, helix_factor: f64, load_factor: f64) -> f64 {
    if pressure > 0.0 { limit / local_contact_stress(pressure, helix_factor, load_factor) } else { f64::NAN }
}

/// Safety of a point of a root fillet against breakage.
///
/// ```text
/// S_F = sigma_FG / (sigma K_A K_V)
/// ```
/// `tension` sigma: largest first principal stress of the point over the mesh, MPa; `limit` sigma_FG, MPa, which is a local stress as well: sigma_Flim Y_ST is that of the reference gears. NaN where nothing pulls. Source: ISO 6336-3, method A of the tooth root stress.
pub fn local_bending_safety(limit: f64, tension: f64, load_factor: f64) -> f64 {
    if tension > 0.0 { limit / (tension * load_factor) } else { f64::NAN }
}
