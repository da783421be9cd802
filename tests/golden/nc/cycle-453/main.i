%main G71 *
; Optimises over the grid of a machine with one rotary axis.
N10 T30 G17 *
N20 G00 X+0 Y+0 *
N30 G453 KINEMATICS GRID ~
    Q406=+1   ;MODE ~
    Q407=+15  ;SPHERE RADIUS ~
    Q320=+0   ;SET-UP CLEARANCE ~
    Q408=+100 ;RETR. HEIGHT ~
    Q253=+1000 ;F PRE-POSITIONING ~
    Q380=+0   ;REFERENCE ANGLE ~
    Q423=+4   ;NO. OF PROBE POINTS ~
    Q431=+0   * ;PRESET
N99999999 %main G71 *
