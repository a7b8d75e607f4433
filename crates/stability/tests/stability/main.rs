//! What linear theory is held to: each file says by what. `tables` reads the references in `data`.

mod across;
mod critical;
mod onset;
mod orbits;
mod raster;
mod response;
mod roots;
mod snaking;
mod tables;
mod walking;
mod wider;
