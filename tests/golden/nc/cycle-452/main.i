%main G70 *
; The tool has drifted: the preset stays, the kinematics move. A programmed M128 lets the probe circle.
N10 T30 G17 *
N20 G00 X+0 Y+0 *
N30 G00 Z+2 M128 *
N40 G452 PRESET COMPENSATION ~
    Q407=+0.5905512 ;SPHERE RADIUS ~
    Q320=+0   ;SET-UP CLEARANCE ~
    Q408=+0   ;RETR. HEIGHT ~
    Q253=MAX  ;F PRE-POSITIONING ~
    Q380=+0   ;REFERENCE ANGLE ~
    Q411=-60  ;START ANGLE A ~
    Q412=+60  ;END ANGLE A ~
    Q413=+0   ;INCID. ANGLE A ~
    Q414=+3   ;MEAS. POINTS A ~
    Q418=+0   ;MEAS. POINTS B ~
    Q419=+90  ;START ANGLE C ~
    Q420=+270 ;END ANGLE C ~
    Q421=+0   ;INCID. ANGLE C ~
    Q422=+3   ;MEAS. POINTS C ~
    Q423=+3   ;NO. OF PROBE POINTS ~
    Q432=+1   * ;BACKLASH, ANG. RANGE
N99999999 %main G70 *
