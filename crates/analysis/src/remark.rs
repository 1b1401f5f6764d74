//! The table of remarks: all sentences that accompany the results of this crate and its stores.
//!
//! A row has a code, values with their units, the sentence, and an action (empty: none). `docs/remarks.md` is generated
//! from it.

pub use answer::Remark;

answer::remarks! {
    // Bodies and meshes.
    free_cut_sector(gear, meshed_teeth, teeth, softer)
        "the {gear}'s mesh has {meshed_teeth} of {teeth} teeth and free cuts: it is softer than the whole gear{softer}",
        "use it for comparison only";
    rim_held(gear, bore_mm, rim_over_tooth_height, solid_mm, softer_percent)
        "the {gear}'s bore of {bore_mm:.2} mm is held rigidly and stiffens the teeth, with a rim of {rim_over_tooth_height:.2} tooth heights between: solid down to {solid_mm:.2} mm, the mean transmission error would be {softer_percent:.0} % larger (coarse solid gears), and a rim on a web is softer than that",
        "mesh the body down to where it is held";
    bore_gives(gear, given_um, share_percent)
        "the {gear} turns and moves on the springs of its bore by {given_um:.2} um along the line of action, {share_percent:.0} % of the mean transmission error",
        "see that [{gear}.bore] states what holds the gear: a bearing beside it gives once more, and one that passes no torque lets the gear of a pair turn";
    locking_elements(gear, element, poisson)
        "the {gear}'s mesh has {element} elements, which lock at a Poisson's ratio of {poisson}: the body is too stiff, linear ones by a multiple",
        "mesh it with hexahedra";
    stiff_elements(gear, element)
        "the {gear}'s mesh has linear {element} elements, which are several times too stiff in bending where few of them lie across a tooth",
        "mesh it with second-order elements or with hexahedra";
    mesh_finding(file, finding) "{file}: {finding}", "";
    flanks_found(file, flanks, deviation_um, turned)
        "{file}: no flank is named; {flanks} flanks found by fit, nodes within {deviation_um:.2} um{turned}",
        "";
    mesh_lacks_face(flank, share_percent, cure) "{flank}", "{cure}";
    undercut(gear, form_diameter_mm, least_profile_shift, profile_shift)
        "the {gear} is undercut: its involute begins at diameter {form_diameter_mm:.3} mm and its roots are weak",
        "a `profile_shift` of {least_profile_shift:.3} or more (it is {profile_shift}) or more teeth avoid that";
    axial_assembly(overlap_deg)
        "the pinion cannot be put into the ring radially: its tip corners would run into those of the ring by {overlap_deg:.3} deg of the pinion",
        "put it in along the axis, or shorten the tips (`tip_diameter_mm`)";
    shaper_trims(overlap_deg, shaper_teeth)
        "a shaper of {shaper_teeth} teeth that is fed radially trims the tips of the ring, by {overlap_deg:.3} deg of the shaper; here they are whole",
        "fewer `teeth` in [wheel.shaper] avoid that";
    root_stress_coarse(gear, stress_mpa, error_percent)
        "the {gear}'s root stress of {stress_mpa:.1} MPa may be {error_percent:.0} % off: its mesh is coarse in the fillet",
        "take elements of order 2; raise `elements_fillet`, `elements_thickness` and `elements_rim` together, or bring a mesh that is finer there";

    // Resolution of the contact.
    few_face_elements(gear, elements, elements_enough)
        "{elements} elements along the face of the {gear} are few for its width",
        "{elements_enough} would do (`elements_face` in [{gear}.mesher]; left out, the program chooses)";
    few_slices(slices, mean_error_percent, swing_error_percent, peak_error_percent, slices_enough)
        "{slices} slices are few for this pair: on a row of independent springs they are off by {mean_error_percent:.1} % in the mean, {swing_error_percent:.0} % in the peak to peak and {peak_error_percent:.0} % in the largest line load",
        "{slices_enough} would do (`slices` in [contact]; left out, the program chooses)";
    short_waves(gear, flank, share_percent, rms_um, longest_mm, wave_number_limit, half_width_mm, wave_number_rad_per_mm, wave_number_by_half_width, wavelength_mm, pressure_mpa)
        "the topography of the {gear}'s {flank} flanks holds waves shorter than the contact band: {share_percent:.0} % of its deviation (rms {rms_um:.3} um, parabola taken off) is shorter than {longest_mm:.2} mm along the profile, k a above {wave_number_limit} beside a band of half-width a = {half_width_mm:.3} mm; the largest has k = {wave_number_rad_per_mm:.2} rad/mm (k a = {wave_number_by_half_width:.2}, wavelength {wavelength_mm:.3} mm). The transmission error has their mean over the band. The largest pressure is that of the smooth flank: pressed flat, these waves add {pressure_mpa:.0} MPa to it (rms)",
        "pressed points (`method = \"nodal\"` in [contact]) see waves that their mesh resolves";
    aliased_wave(gear, order, amplitude_um, positions, positions_enough)
        "the {gear}'s wave of order {order} ({amplitude_um:.3} um) has fewer than two positions a period: with {positions} positions a mesh cycle it shows at another order",
        "{positions_enough} would do (`positions_per_cycle` in [analysis])";
    orders_of_no_turn(gear, cycles, teeth)
        "{cycles} mesh cycles are no whole turn of the {gear} of {teeth} teeth: orders that its flanks and pitch errors make fall between the lines of spectra over them",
        "ask for whole turns: `turn = \"{gear}\"`, or with both gears `turn = \"hunting\"` in [analysis]";
    window_widened(failure, teeth) "{failure}; the window was widened to {teeth} teeth", "";
    window_widened_in_motion(failure, teeth)
        "{failure}; the window was widened to {teeth} teeth and the motion begun again", "";

    // Loads and deflections.
    jammed(positions, of_positions, normal_force_n, times, needed_n)
        "driving and coast flanks press at once in {positions} of {of_positions} positions, the gears jam: normal forces add up to {normal_force_n:.0} N, {times} the {needed_n:.0} N that the torque asks for",
        "give more backlash (`thickness_allowance_mm` in [pinion] and [wheel], `centre_distance_mm` in [pair]) or less misalignment";
    light_load(approach_mm, round_off_mm)
        "the load is too light: the teeth approach each other by at most {approach_mm:.1e} mm, and positions are accurate to {round_off_mm:.1e} mm only; transmission error, stiffness and contact lines have few correct digits or none",
        "take a larger torque, or none";
    large_deflection(transmission_error_mm, module_mm)
        "the transmission error reaches {transmission_error_mm:.3} mm at a module of {module_mm} mm: elasticity here is linear and holds for small deflections",
        "is the torque in N m?";
    doubtful_load(estimate, limit_modules, cure)
        "{estimate}; beyond {limit_modules} modules a result means nothing", "{cure}";

    // Values that are possible and unlikely.
    soft_material(gear, young_mpa, other) "`young_mpa` of the {gear} is {young_mpa}, softer than plastics", "{other}";
    unlikely_density(gear, density_kg_m3, other)
        "`density_kg_m3` of the {gear} is {density_kg_m3}, which no material of gears has", "{other}";
    small_bore(gear, bore_diameter_mm, reference_diameter_mm, other)
        "the bore of the {gear} is {bore_diameter_mm} mm in a gear of {reference_diameter_mm} mm", "{other}";
    small_thinning(gear, thickness_allowance_mm, other)
        "`thickness_allowance_mm` of the {gear} is {thickness_allowance_mm}, less than can be measured", "{other}";
    deep_flanks(gear, depth_um, depth_modules)
        "the flanks of the {gear} are {depth_um} um away from the involute, {depth_modules} modules: micro-geometry is in um, and some 20 um a mm of module are usual",
        "";
    shallow_flanks(gear, depth_um, depth_if_mm_um)
        "the flanks of the {gear} are {depth_um} um away from the involute at the most, less than can be ground",
        "{depth_um} mm are {depth_if_mm_um} um";
    small_helix(helix_angle_deg, other) "`helix_angle_deg` is {helix_angle_deg}, nearly a spur gear", "{other}";
    unlikely_width(face_width_mm, over_module, module_mm, other)
        "`face_width_mm` is {face_width_mm}, {over_module} times the module of {module_mm} mm", "{other}";
    large_backlash(backlash_mm, backlash_modules)
        "the backlash is {backlash_mm} mm, {backlash_modules} modules: are `centre_distance_mm` and `thickness_allowance_mm` in mm?",
        "";
    ring_shift_of_other_sign(profile_shift, backlash_mm, profile_shift_that_fits)
        "with `profile_shift` {profile_shift} of the ring the backlash is {backlash_mm} mm; {profile_shift_that_fits} fits the centre distance: ISO 21771 has minus the sign of conventions with z_2 > 0",
        "";
    speed_in_rad_per_s(speed_rpm, speed_if_rad_per_s_rpm)
        "`speed_rpm` is {speed_rpm}; {speed_rpm} rad/s are {speed_if_rad_per_s_rpm} rpm, was that meant?", "";

    // Standards.
    rating_outside(quantity, value, clause, range)
        "the rating is outside of its standard: {quantity} is {value:.3}, {clause} covers {range}", "";
    rating_states_few_loads(gear, times, reversed)
        "gear {gear} is rated with fewer loads than its meshes put on it: {times} a turn on the flank that this mesh loads, and {reversed:.3} of this load on the other flank",
        "leave `meshes_per_turn` and `reversed_load_ratio` of the gear out, and the loads of its meshes count";
    rating_unloaded()
        "the mesh carries no torque, or does not turn: it is not rated", "";
    rating_fails(gear, failure, safety)
        "the {gear} does not hold: its safety against {failure} is {safety:.3}", "";
    spectrum_fails(gear, failure, damage)
        "the {gear} does not outlive the load spectrum: Miner's sum of {failure} is {damage:.3}, above 1", "";
    local_spectrum_fails(gear, failure, damage, diameter_mm, z_mm)
        "the {gear} does not outlive the load spectrum by its solved stresses: Miner's sum of {failure} is {damage:.3} at a diameter of {diameter_mm:.3} mm, z {z_mm:.2} mm, above 1",
        "at an edge or an end face add relief or crowning; elsewhere a larger face, a harder material or less load";
    no_iso_root_stress(reason) "no nominal root stress after ISO 6336-3: {reason}", "";
    iso_model(bending_um)
        "model \"iso\": stiffness after ISO 6336-1, load spread evenly over the contact lines, and {bending_um:.2} um by which the axial force bends the bodies, solid discs held at their bores; mean values are meant to hold within about 25 %, the shape over the mesh cycle is a rough guess",
        "";
    iso_low_contact_ratio(contact_ratio, least_contact_ratio)
        "model \"iso\": the transverse contact ratio is {contact_ratio:.3}; below {least_contact_ratio} ISO 6336-1 asks for a lower stiffness, by up to 10 % for spur gears, and gives no formula",
        "";
    iso_soft_bodies(bending_percent)
        "model \"iso\": the axial force bends the bodies by {bending_percent:.0} % of the teeth's own deflection: webs, rims and hubs then matter, which the formula leaves out",
        "use `model = \"reduced\"` with meshes of the true bodies";

    // Motion.
    coarse_steps(steps_in_period, motion, frequency_hz, cure)
        "a step is 1/{steps_in_period:.1} of the period of the {motion} ({frequency_hz:.0} Hz): too long to resolve it",
        "take {cure}";
    slow_pair(periods, fastest_hz, steps)
        "a mesh cycle lasts {periods:.0} periods of the fastest motion that steps must resolve ({fastest_hz:.3e} Hz), so it takes {steps:.0} steps; at such a low speed `kind = \"static\"` gives nearly the same answer",
        "";
    many_steps(estimate, highest_hz)
        "with its normal modes this motion takes {estimate}: the highest kept mode, {highest_hz:.0} Hz, sets their length, and the lowest settles slowly",
        "fewer modes (`below_hz` in [modes]), more damping of them or a larger `periodic_tolerance` make it shorter";
    no_backlash(effect)
        "the pair has no backlash: {effect}",
        "give `thickness_allowance_mm` in [pinion] and [wheel] (or a larger `centre_distance_mm` in [pair])";
    mesh_without_backlash(or)
        "the mesh has no backlash: where the driving flanks lose contact the coast flanks press at once, and there is no loss of contact as with a clearance",
        "give {or}`thickness_allowance_mm` in [pinion] and [wheel]";
    repeats_and_drifts(tolerance, mesh_cycles, off)
        "the motion repeated itself to {tolerance:.0e} of its peak to peak after {mesh_cycles} mesh cycles, but the cycles that were written repeat to {off:.1e} only",
        "ask for a smaller `periodic_tolerance`, or give a transient more damping";
    not_periodic(mesh_cycles, off, tolerance, why)
        "the motion does not repeat itself: after {mesh_cycles} mesh cycles it is off by {off:.1e} of its peak to peak (asked: {tolerance:.0e}); {why}",
        "";
    no_common_period()
        "the meshes do not come back together within 100000 cycles of the fastest: section.csv is not written", "";
    subharmonic(mesh_cycles) "the motion repeats itself after {mesh_cycles} mesh cycles: a subharmonic answer", "";
    work_open(share)
        "the energy balance closes only to {share:.1e} of the work that goes through the pair (asked: 1e-6)",
        "take smaller steps or `method = \"energy\"`";
    vibration_energy_open(share, limit, cure)
        "the energy balance closes only to {share:.1e} of the energy of the vibration (asked: {limit:.0e})",
        "{cure}";
    gap_beyond_backlash(gap_um, backlash_um)
        "the gap between the driving flanks reaches {gap_um:.1} um, more than the backlash of {backlash_um:.1} um: the coast flanks would touch",
        "use `flanks = \"both\"`";
    both_flanks_press(rows, bound_um)
        "in {rows} rows driving and coast flanks press at once; that each side also bends the teeth of the other is left out, which shifts positions by up to {bound_um:.3} um",
        "a backlash keeps them apart";
    speed_has_changed(mean_rpm, start_rpm)
        "the driver's mean speed is {mean_rpm:.1} rpm, it began with {start_rpm:.1} rpm: mesh cycles, and orders of the spectrum, are those of the start",
        "";
    few_rows(rows, share_percent, from_order, to_order, limit_percent, cure)
        "{rows} rows a mesh cycle do not show all that moves: {share_percent:.0} % of the vibration lies between the mesh orders {from_order} and {to_order}, and more may lie beyond (reported from {limit_percent:.0} % on); peaks fall between the rows",
        "take {cure}";
    few_steps(percent, order, steps_in_period, limit_percent, cure)
        "steps change the peak to peak of the DTE by about {percent:.1} %, most of it mesh order {order}, whose period has {steps_in_period:.1} of them (reported from {limit_percent:.0} % on)",
        "take {cure}";
    fast_rotation(share_percent, limit_percent)
        "the gears turn so fast that Coriolis and centrifugal forces on their elastic deformation, which are left out, reach {share_percent:.0} % of the elastic ones (reported from {limit_percent:.1} % on): expect that much of an error in elastic deflections and frequencies",
        "";
    quasi_static_elasticity(harmonic, harmonic_hz, ratio, gear, mode, change_um, change_percent, limit_percent, remedy, price)
        "mesh harmonic {harmonic} at {harmonic_hz:.0} Hz is {ratio:.2} of the {gear}'s {mode}; elasticity is quasi-static there, and its inertia may change the peak to peak of the DTE by up to {change_um:.3} um, {change_percent:.0} % of it (reported from {limit_percent:.1} % on)",
        "{remedy}, {price}";
    inertia_not_judged()
        "elasticity is quasi-static; how much its inertia would change is estimated by a run at one speed alone",
        "";
    whole_cycles(cycles, lasts_s, duration_s)
        "whole mesh cycles are run: {cycles}, which last {lasts_s:.4e} s where {duration_s:?} s were asked for",
        "";
    run_up_torque(duration_s, inertia_torque_nm, place, share_percent, load_torque_nm, cure)
        "the speed changes within {duration_s} s: that takes up to {inertia_torque_nm:.1} N m at {place}, {share_percent:.0} % of the load of {load_torque_nm:.1} N m there, and the meshes carry the sum",
        "{cure}";
    coarse_order_cut(points, order, speed_rpm, points_enough, times, cure)
        "the peak of order {order} at {speed_rpm:.0} rpm has {points} of the {points_enough} points across it that show its height and place",
        "{cure}, by a factor of {times:.1} or more";
    impact_exponent(stiffness_n_per_mm_to_1_5, exponent)
        "the impact stiffness of {stiffness_n_per_mm_to_1_5:.4e} N/mm^1.5 is that of two balls and belongs to the exponent 1.5; here it is taken with {exponent}",
        "give `stiffness_n_per_mm_to_exponent`";

    // Many motions.
    speeds_not_periodic(speeds, of_speeds, listed)
        "no periodic state was found at {speeds} of {of_speeds} speeds ({listed}): chaotic, of a longer period, or `warm_up_cycles` are too few",
        "";
    speeds_unsolved(speeds, of_speeds, listed, reason)
        "{speeds} of {of_speeds} speeds have no solution ({listed}); their rows in resonance.csv say why, the first: {reason}",
        "";
    points_unsolved(points, of_points, reason)
        "{points} of {of_points} points have no solution; their rows in sweep.csv say why, the first: {reason}", "";
    points_not_periodic(points, of_points)
        "at {points} of {of_points} points the section does not come back: chaotic, quasi-periodic, or `warm_up_cycles` are too few",
        "a Lyapunov exponent (`ale-gear vary --start carry --lyapunov 200`) tells which";
    starts_unsolved(starts, of_starts, reason)
        "{starts} of {of_starts} starts have no motion; their rows in basins.csv are empty, the first because {reason}", "";
    starts_not_periodic(starts, of_starts)
        "from {starts} of {of_starts} starts the motion does not come back within eight mesh cycles: chaotic, quasi-periodic, or `warm_up_cycles` are too few; they are counted as one",
        "";
    branch_ends(reason)
        "the branch ends within its range: {reason}",
        "more `motions`, `most_harmonics` or `phases`, or a larger `tail`, may lead on";
    branch_apart(difference_percent)
        "a motion integrated in time differs from the branch by {difference_percent:.1} %: near a fold it has jumped, else its steps are too long (`steps_per_mesh_cycle`, `steps_per_resonance`; of a gearbox `steps_per_cycle`)",
        "";
    branch_turns_back()
        "the branch turns back and leaves the range where it began: another one leads on",
        "begin at the other end of the range";
    torus_bifurcation()
        "beyond a torus bifurcation the motion has a second frequency: the branch goes on, unstable, and no periodic motion near it is seen in time",
        "";
    period_doubling(begins_at, key, value)
        "a motion of twice the period begins at {begins_at:.6}: `{key}` = {value} follows it", "";

    // Gearboxes.
    branch_linear_bearings()
        "along the branch rolling bearings are springs about their mean equilibrium; motions integrated in time follow the laws of the bearings",
        "";
    vibration_beyond_load(force_n, speed_rpm, order, exciting, load_n, speeds, of_speeds, listed)
        "the linear vibration takes up to {force_n:.0} N off the mean load of {load_n:.0} N at {speed_rpm:.0} rpm, most of it by order {order} of mesh {exciting}: the flanks would lose contact, which a linear vibration leaves out; so at {speeds} of {of_speeds} speeds ({listed})",
        "a motion at these speeds includes it (`[motion]` with `mesh = \"mapped\"`)";
    bearings_estimated(bearings, estimates)
        "rolling elements or ratings of {bearings} bearings are estimated from bore, outer diameter and static rating or width: {estimates}",
        "state `elements` with their sizes, `static_rating_kn` and `dynamic_rating_kn` where they are known";
    bearing_on_held_shaft(bearing)
        "bearing {bearing} is on a shaft that is held: its rolling elements carry nothing", "";
    bearing_unloaded(bearing)
        "bearing {bearing} carries nothing at any position: the shaft floats in its clearance", "";
    bearing_tilts(bearing, tilt_mrad, elements, limit_mrad)
        "bearing {bearing} tilts by {tilt_mrad:.1} mrad: catalogues let {elements} bearings tilt by some {limit_mrad:.1} mrad at most",
        "";
    bearing_fast(bearing, speed_factor_mm_per_min, limit_mm_per_min)
        "bearing {bearing} runs at n d_m = {speed_factor_mm_per_min:.0} mm/min: above some {limit_mm_per_min:.0} mm/min centrifugal forces press its elements to the outer ring, which are left out of stiffness, life and loss",
        "";
    bearing_pressure(bearing, pressure_mpa, element, limit_mpa)
        "bearing {bearing}: {pressure_mpa:.0} MPa on a {element}, beyond the {limit_mpa:.0} MPa of the static rating (ISO 76): steel no longer stays elastic",
        "";
    bearing_life_outside(bearing, load_over_rating)
        "bearing {bearing}: its equivalent load is {load_over_rating:.2} of its dynamic rating; formulas of lives hold up to 0.5 (ISO 281)",
        "";
    bearing_film_outside(bearing)
        "bearing {bearing}: the oil is thinner than a tenth of what its speed asks for, where ISO 281 has no modified life",
        "take a thicker oil";
    seat_elsewhere(gear, held_mm, seat_mm, better_seat_mm)
        "the mesh of gear {gear} is held about z = {held_mm:.3} mm from its mid-plane, and its seat is at {seat_mm:.3} mm",
        "set `seat_mm = {better_seat_mm:.3}`";
    few_gear_modes(gear, highest_hz, excitation_hz, enough_hz)
        "the elastic modes of gear {gear} are kept up to {highest_hz:.0} Hz, and mesh orders reach {excitation_hz:.0} Hz: beyond its modes the gear deflects as at rest",
        "keep more modes: `below_hz = {enough_hz:.0}` in place of `count` in [modes]";
    gear_modes_do_not_travel(gear)
        "gear {gear} is not cyclic: its elastic modes are those of its angle at the start and do not turn with it",
        "mesh one periodic sector (`sector_teeth = 1`)";
    gears_at_one_place(gear, other, shaft) "gears {gear} and {other} stand at one place of shaft {shaft}", "";
    gear_beyond_shaft(gear, beyond_mm, shaft)
        "gear {gear} reaches {beyond_mm:.3} mm beyond the end of shaft {shaft}", "";
    shaft_thicker_than_root(shaft, shaft_mm, gear, root_circle_mm)
        "shaft {shaft} is {shaft_mm:.3} mm thick where gear {gear} has a root circle of {root_circle_mm:.3} mm", "";
    parts_collide(kind, part, other_kind, other, overlap_mm)
        "{kind} {part} and {other_kind} {other} reach into each other by {overlap_mm:.3} mm", "";
    planets_without_play(planets, lost_mm, first, second, play_mm)
        "errors of the pins of \"{planets}\" take {lost_mm:.3} mm along the lines of action, \"{first}\" and \"{second}\" have {play_mm:.3} mm of backlash: flanks on the other side touch, and their forces are missing",
        "smaller `tangential_errors_um`, or more backlash";

    unlikely_shaft_modulus(shaft, young_mpa, than, other)
        "`young_mpa` of the shaft \"{shaft}\" is {young_mpa}, {than}", "{other}";
    unlikely_shaft_density(shaft, density_kg_m3, other)
        "`density_kg_m3` of the shaft \"{shaft}\" is {density_kg_m3}, which no metal has", "{other}";
    bore_beside_shaft(bearing, bore_mm, shaft, shaft_diameter_mm)
        "the bore of the {bearing} is {bore_mm} mm, and the shaft \"{shaft}\" has {shaft_diameter_mm} mm there",
        "take a bearing of that bore, or state the section on which it sits";
    unlikely_bearing_stiffness(bearing, stiffness_n_per_mm, than, shaft_diameter_mm, other)
        "the stiffness of the {bearing} is {stiffness_n_per_mm} N/mm across the axis, {than} for a shaft of {shaft_diameter_mm} mm",
        "{other}";
    unlikely_gear_mass(gear, mass_kg, solid_mass_kg, other)
        "`mass_kg` of the gear \"{gear}\" is {mass_kg}, a solid one has {solid_mass_kg}", "{other}";
    unlikely_gear_inertia(gear, key, inertia_kg_m2, solid_inertia_kg_m2, other)
        "`{key}` of the gear \"{gear}\" is {inertia_kg_m2}, a solid disc has about {solid_inertia_kg_m2}", "{other}";
    unlikely_machine_inertia(place, inertia_kg_m2, over_gears, other)
        "`inertia_kg_m2` of {place} is {inertia_kg_m2}, {over_gears} times that of the gears on its shaft", "{other}";

    // Many cases.
    pressure_limit_passed(limits, by)
        "the limit of the pressure, {limits}, is {by}: no design was found that keeps it", "";
    limit_passed(limits) "no design was found that keeps its limits: {limits}", "";
    cases_unsolved(cases, of_cases)
        "{cases} of {of_cases} cases have no result: `reason` in cases.csv says why", "";
    case_unsolved(reason) "no result: {reason}; tables, charts and correlations are without it", "";
    no_correlation(column, beside, reason) "no correlation of {column} with {beside}: {reason}", "";
    no_full_model(reason) "there is no model of all degrees of freedom to compare with: {reason}", "";
    result_failed(run, words) "{run} FAILED A CHECK: {words}", "";

    // Stores and pictures.
    gear_not_loaded(file, reason) "{file}: {reason}; the gear was reduced again", "";
    gear_not_stored(file, reason) "{file}: {reason}; the next run will reduce the gear again", "";
    pitch_errors_on_map(checks, rms_error_um, largest_error_um, error_percent)
        "pitch errors act on the map as an offset of each tooth pair: compared with exact contact at {checks} points, the approach is off by {rms_error_um:.3} um (rms) and {largest_error_um:.3} um (largest), {error_percent:.2} % of the mean deflection",
        "exact contact has no such error: `model = \"reduced\"`, in a gearbox `mesh = \"exact\"` in [motion]";
    map_not_loaded(file, reason) "{file}: {reason}; the contact was mapped again", "";
    map_not_stored(file, reason) "{file}: {reason}; the next run will map the contact again", "";
    no_view(reason) "the report has no fields in space: {reason}", "";
}
