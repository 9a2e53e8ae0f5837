# RUN: kbc import lif ../../../data/layouts/lif/08-station-with-two-nodes-restricted-for-different-ve.json --vehicle Vehicle_Type_2
# RUN: kbc import lif ../../../data/layouts/lif/24-edge-with-physicalLineGuidedProperty.json --vehicle Series_1 --by azimuth
