# PALPATE_ADDRESSES_BUILD names a folder in which palpate_core is built already, as a shared library. Then
# palpate_addresses can be built (scripts/checks/check_addresses.sh --quick): that core with some rooms compiled anew, by
# the flags of this build, in place of their own.
set(PALPATE_ADDRESSES_BUILD "" CACHE PATH "For palpate_addresses: a build of palpate_core")
